#include "report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

namespace whirl_twin::comparison {
namespace {

/// The cheapest of one side at a level.
struct Best {
  const Contender* contender = nullptr;
  const Point* point = nullptr;
  double cost_ms = 0.0;
};

Best best(const MeasuredScene& measured, bool ours, double level, bool with_preparation) {
  Best found;
  for (std::size_t i = 0; i < measured.curves.size(); ++i) {
    const Contender& contender = measured.scene.contenders[i];
    const Point* point = cheapest(measured.curves[i], level, with_preparation);
    if (contender.ours != ours || point == nullptr) {
      continue;
    }
    const double cost = point->cpu_ms + (with_preparation ? point->prepare_ms : 0.0);
    if (found.point == nullptr || cost < found.cost_ms) {
      found = {&contender, point, cost};
    }
  }
  return found;
}

/// "0.53 ms" for a step, "1e-07" for a tolerance.
std::string setting(const MeasuredScene& measured, const Contender& contender, const Point& point) {
  return contender.ladder == Ladder::kSteps
             ? fmt::format("{:.3g} ms", 1.0e3 * measured.scene.output.interval / point.setting)
             : fmt::format("{:.0e}", point.setting);
}

std::string joined(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

std::string ratio(const Best& peer, const Best& ours) {
  if (ours.point == nullptr) {
    return "–";
  }
  return peer.point == nullptr ? "no peer meets it"
                               : fmt::format("**{:.3g}**", peer.cost_ms / ours.cost_ms);
}

void writeSummary(std::ostream& out, const std::vector<MeasuredScene>& scenes) {
  out << "| scene | error | whirl_twin, CPU ms | best peer, CPU ms | ratio | preparation included "
         "|\n|---|---|---|---|---|---|\n";
  for (const MeasuredScene& measured : scenes) {
    for (const double level : kLevels) {
      const auto cell = [&](const Best& b) {
        return b.point == nullptr ? std::string("–")
                                  : fmt::format("{:.3g} ({}, {})", b.cost_ms, b.contender->name,
                                                setting(measured, *b.contender, *b.point));
      };
      const Best ours = best(measured, true, level, false);
      const Best peer = best(measured, false, level, false);
      const Best ours_prepared = best(measured, true, level, true);
      const Best peer_prepared = best(measured, false, level, true);
      out << fmt::format("| {} | {:.0e} | {} | {} | {} | {} |\n", measured.scene.name, level,
                         cell(ours), cell(peer), ratio(peer, ours),
                         ratio(peer_prepared, ours_prepared));
    }
  }
}

/// CPU ms of a contender at a level, its setting, and for a peer the ratio to ours.
std::string cell(const MeasuredScene& measured, std::size_t index, double level) {
  const Contender& contender = measured.scene.contenders[index];
  const Point* point = cheapest(measured.curves[index], level);
  if (point == nullptr) {
    return "–";
  }
  const Best ours = best(measured, true, level, false);
  const std::string times = contender.ours || ours.point == nullptr
                                ? ""
                                : fmt::format("; {:.3g} x", point->cpu_ms / ours.cost_ms);
  return fmt::format("{:.3g} ({}{})", point->cpu_ms, setting(measured, contender, *point), times);
}

void writeScene(std::ostream& out, const MeasuredScene& measured) {
  const ComparedScene& scene = measured.scene;
  out << fmt::format(
      "\n### {}\n\n{}; {:.4g} s, compared every {:.3g} s with the reference: {}, its own error "
      "below {:.0e}.\n\n",
      scene.name, scene.description, scene.output.horizon(), scene.output.interval,
      scene.reference.origin, std::max(scene.reference.error, 1.0e-16));
  out << "| CPU ms (setting; times the best whirl_twin) for an error of |";
  for (const double level : kLevels) {
    out << fmt::format(" {:.0e} |", level);
  }
  out << " smallest error found |\n|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < measured.curves.size(); ++i) {
    const Contender& contender = scene.contenders[i];
    const char* mark = contender.ours ? "**" : "";
    out << fmt::format("| {}{}{} |", mark, contender.name, mark);
    for (const double level : kLevels) {
      out << " " << cell(measured, i, level) << " |";
    }
    double least = measured.curves[i].front().error;
    for (const Point& point : measured.curves[i]) {
      least = std::min(least, point.error);
    }
    out << fmt::format(" {:.0e} |\n", least);
  }
}

}  // namespace

void writeMarkdown(std::ostream& out, const std::vector<MeasuredScene>& scenes,
                   const Circumstances& circumstances) {
  out << fmt::format(
      "Peers: {}. Not found: {}. Median of {} interleaved rounds; load {:.2f} "
      "before, {:.2f} after.\n\n",
      joined(circumstances.peers.present), joined(circumstances.peers.missing),
      circumstances.effort.rounds, circumstances.load_before, circumstances.load_after);
  writeSummary(out, scenes);
  for (const MeasuredScene& measured : scenes) {
    writeScene(out, measured);
  }
}

void writeJson(std::ostream& out, const std::vector<MeasuredScene>& scenes,
               const Circumstances& circumstances) {
  using Json = nlohmann::ordered_json;
  Json all{{"peers", circumstances.peers.present},   {"missing", circumstances.peers.missing},
           {"rounds", circumstances.effort.rounds},  {"load_before", circumstances.load_before},
           {"load_after", circumstances.load_after}, {"scenes", Json::array()}};
  for (const MeasuredScene& measured : scenes) {
    const ComparedScene& scene = measured.scene;
    Json of_scene{{"name", scene.name},
                  {"horizon", scene.output.horizon()},
                  {"sample_interval", scene.output.interval},
                  {"reference", scene.reference.origin},
                  {"reference_error", scene.reference.error},
                  {"contenders", Json::array()}};
    for (std::size_t i = 0; i < measured.curves.size(); ++i) {
      const Contender& contender = scene.contenders[i];
      const bool steps = contender.ladder == Ladder::kSteps;
      Json points = Json::array();
      for (const Point& point : measured.curves[i]) {
        Json of_point{{steps ? "step" : "tolerance",
                       steps ? scene.output.interval / point.setting : point.setting},
                      {"error", point.error},  // null: not finite
                      {"first_cpu_ms", point.first_ms}};
        if (point.cpu_ms > 0.0) {
          of_point["cpu_ms"] = point.cpu_ms;
          of_point["prepare_cpu_ms"] = point.prepare_ms;
        }
        points.push_back(of_point);
      }
      of_scene["contenders"].push_back(
          {{"name", contender.name}, {"ours", contender.ours}, {"points", points}});
    }
    all["scenes"].push_back(of_scene);
  }
  out << all.dump(2) << "\n";
}

}  // namespace whirl_twin::comparison
