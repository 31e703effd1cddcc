#include "reports/report_page.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "messages/names.h"

namespace whirl_twin {

namespace {

constexpr const char* kReportPageStyle =
    "body{font:15px/1.5 sans-serif;color:#21212a;max-width:66em;margin:2em auto;padding:0 1em}"
    "table{border-collapse:collapse;margin:1em 0;font-size:14px}"
    "th,td{text-align:left;padding:.2em .8em;border-bottom:1px solid #ddd;vertical-align:top}"
    "td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}"
    "svg{max-width:100%;height:auto;display:block;margin:1em 0}"
    "h2{margin-top:2em;border-bottom:2px solid #0072b2}"
    "@media print{body{max-width:none;margin:0;font-size:11px}table{font-size:10px}"
    "svg,tr{break-inside:avoid}h2,h3{break-after:avoid}thead{display:table-header-group}}";

bool beginsLikeANumber(const std::string& cell) {
  const std::size_t at = cell.empty() || (cell[0] != '-' && cell[0] != '+') ? 0 : 1;
  return at < cell.size() && cell[at] >= '0' && cell[at] <= '9';
}

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

std::string escapedForHtml(const std::string& text) {
  std::string out;
  for (const char c : printableLines(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

std::string inlinedPicture(const Figure& figure, int number) {
  std::string file = figureImage(figure, ImageFormat::kSvg);
  const std::size_t start = file.find("<svg");
  file = start == std::string::npos ? "" : file.substr(start);
  const std::array<std::pair<const char*, const char*>, 3> names{
      {{" id=\"", ""}, {"href=\"#", ""}, {"url(#", ""}}};
  for (const auto& [before, after] : names) {
    replaceAll(file, before, fmt::format("{}p{}-{}", before, number, after));
  }
  return file;
}

ReportPage::ReportPage(const std::string& title) : title_(title) {}

void ReportPage::section(const std::string& title) {
  body_ += fmt::format("<h2>{}</h2>\n", escapedForHtml(title));
}

void ReportPage::part(const std::string& title) {
  body_ += fmt::format("<h3>{}</h3>\n", escapedForHtml(title));
}

void ReportPage::text(const std::string& words) {
  body_ += fmt::format("<p>{}</p>\n", escapedForHtml(words));
}

void ReportPage::list(const std::vector<std::string>& lines) {
  body_ += "<ul>\n";
  for (const std::string& line : lines) {
    body_ += fmt::format("<li>{}</li>\n", escapedForHtml(line));
  }
  body_ += "</ul>\n";
}

void ReportPage::table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows) {
  body_ += "<table><thead><tr>";
  for (const std::string& cell : head) {
    body_ += fmt::format("<th>{}</th>", escapedForHtml(cell));
  }
  body_ += "</tr></thead><tbody>\n";
  for (const std::vector<std::string>& row : rows) {
    body_ += "<tr>";
    for (const std::string& cell : row) {
      body_ += fmt::format("<td{}>{}</td>", beginsLikeANumber(cell) ? " class=\"n\"" : "",
                           escapedForHtml(cell));
    }
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table>\n";
}

void ReportPage::picture(const Figure& figure) {
  body_ += inlinedPicture(figure, ++pictures_) + "\n";
}

std::string ReportPage::finish() const {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>"
      "<style>{1}</style></head><body>\n<h1>{0}</h1>\n{2}</body></html>\n",
      escapedForHtml(title_), kReportPageStyle, body_);
}

}  // namespace whirl_twin
