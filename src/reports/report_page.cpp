#include "reports/report_page.h"

#include <utility>

namespace whirl_twin {

ReportPage::ReportPage(const std::string& title)
    : page_{{"title", title},
            {"facts", Json::array()},
            {"summary", Json::array()},
            {"parts", Json::array()}} {}

void ReportPage::fact(const std::string& name, const std::string& value) {
  page_["facts"].push_back(Json::array({name, value}));
}

void ReportPage::summary(const std::string& line) {
  page_["summary"].push_back(line);
}

void ReportPage::add(const char* kind, Json content) {
  page_["parts"].push_back({{kind, std::move(content)}});
}

void ReportPage::section(const std::string& title) {
  add("section", title);
}

void ReportPage::part(const std::string& title) {
  add("part", title);
}

void ReportPage::text(const std::string& text) {
  add("text", text);
}

void ReportPage::list(const std::vector<std::string>& lines) {
  add("list", lines);
}

void ReportPage::cells(const std::vector<std::string>& head,
                       const std::vector<std::vector<Json>>& rows) {
  add("table", {{"head", head}, {"rows", rows}});
}

void ReportPage::table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows) {
  add("table", {{"head", head}, {"rows", rows}});
}

void ReportPage::picture(const Figure& figure) {
  add("figure", figureJson(figure));
}

}  // namespace whirl_twin
