#include "python/figure_text.h"

#include "reports/output.h"

namespace whirl_twin {

namespace {

Json axisJson(const ChartAxis& axis) {
  return {{"label", axis.label}, {"logarithmic", axis.logarithmic}, {"degrees", axis.degrees}};
}

Json chartJson(const Chart& chart) {
  Json json{{"title", chart.title}, {"x", axisJson(chart.x)}, {"y", axisJson(chart.y)}};
  json["series"] = listJson(chart.series, [](const Series& series) {
    return Json{{"name", series.name}, {"x", series.x}, {"y", series.y}};
  });
  return json;
}

}  // namespace

std::string figureText(const Figure& figure) {
  const Json json{{"kind", "charts"},
                  {"title", figure.title},
                  {"columns", figure.columns},
                  {"charts", listJson(figure.charts, chartJson)}};
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace whirl_twin
