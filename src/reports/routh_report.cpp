#include "reports/routh_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/report_values.h"

namespace whirl_twin {

namespace {

/// "1/2 + sqrt(5)/2 = 1.61803", "6", "1.26168".
std::string boundText(const StabilityBound& bound) {
  const std::string digits = fmt::format("{:.15g}", bound.value());
  if (bound.closed_form.empty() || bound.closed_form == digits) {
    return digits;
  }
  return fmt::format("{} = {:.6g}", bound.closed_form, bound.value());
}

/// The same for an inequality: without what it is equal to.
std::string shortText(const StabilityBound& bound) {
  return bound.closed_form.empty() ? fmt::format("{:.15g}", bound.value()) : bound.closed_form;
}

std::string countsText(const RouthResult& routh) {
  return fmt::format("{} right, {} on the axis, {} left", routh.right, routh.imaginary, routh.left);
}

/// What happens at a bound.
std::string whyText(const StabilityBound& bound) {
  std::string out;
  const auto add = [&](const std::string& what) { out += (out.empty() ? "" : ", ") + what; };
  if (bound.degree_falls) {
    add("the degree falls");
  }
  if (bound.root_at_zero) {
    add("a root at 0");
  }
  if (bound.pair_on_axis) {
    add(bound.frequency ? fmt::format("a pair on the axis at {:.6g} rad/s", *bound.frequency)
                        : std::string("a pair s, -s"));
  }
  return out;
}

std::string pieceText(const StabilityRange& range, const StablePiece& piece,
                      const std::string& symbol) {
  std::string out;
  if (piece.from) {
    out += fmt::format("{} {} ", shortText(range.bounds[*piece.from]),
                       piece.from_included ? "<=" : "<");
  }
  out += symbol;
  if (piece.to) {
    out +=
        fmt::format(" {} {}", piece.to_included ? "<=" : "<", shortText(range.bounds[*piece.to]));
  }
  if (!piece.to && piece.from) {  // "K > 3" and not "3 < K"
    return fmt::format("{} {} {}", symbol, piece.from_included ? ">=" : ">",
                       shortText(range.bounds[*piece.from]));
  }
  return piece.from || piece.to ? out : "every " + symbol;
}

std::string intervalText(const StabilityRange& range, const StabilityInterval& interval,
                         const std::string& symbol) {
  return pieceText(range, {interval.from, interval.to, false, false}, symbol);
}

Json routhCountsJson(const RouthResult& routh) {
  return {{"verdict", name(routh.verdict)},
          {"right", routh.right},
          {"imaginary", routh.imaginary},
          {"left", routh.left}};
}

}  // namespace

Json json(const RouthTable& table, const std::string& symbol) {
  return listJson(table.rows, [&](const RouthTableRow& row) -> Json {
    const auto entry_text = [&](const SymbolicQuotient& entry) { return text(entry, symbol); };
    return {{"power", row.power},
            {"entries", listJson(row.entry, entry_text)},
            {"note", textOrNull(row.note)}};
  });
}

CsvTable csv(const RouthTable& table, const std::string& symbol) {
  CsvTable all{"", {"power"}};
  for (std::size_t j = 0; j < table.rows.front().entry.size(); ++j) {
    all.columns.push_back(fmt::format("entry_{}", j + 1));
  }
  all.columns.emplace_back("note");
  for (const RouthTableRow& row : table.rows) {
    Json cells{{"power", row.power}, {"note", row.note}};
    for (std::size_t j = 0; j < row.entry.size(); ++j) {
      cells[fmt::format("entry_{}", j + 1)] = text(row.entry[j], symbol);
    }
    all.rows.push_back(cells);
  }
  return all;
}

std::string text(const RouthTable& table, const std::string& symbol) {
  std::vector<std::size_t> widths(table.rows.front().entry.size(), 0);
  for (const RouthTableRow& row : table.rows) {
    for (std::size_t j = 0; j < row.entry.size(); ++j) {
      widths[j] = std::max(widths[j], text(row.entry[j], symbol).size());
    }
  }
  std::string out = "  Routh's table\n";
  if (table.zero_roots > 0) {
    out += fmt::format("    of the polynomial divided by s^{}: so many roots at 0\n",
                       table.zero_roots);
  }
  for (const RouthTableRow& row : table.rows) {
    if (!row.note.empty()) {
      out += fmt::format("    s^{} {}\n", row.power, row.note);
    }
    std::string line = fmt::format("    {:<5}", fmt::format("s^{}", row.power));
    for (std::size_t j = 0; j < row.entry.size(); ++j) {
      line += fmt::format("  {:>{}}", text(row.entry[j], symbol), widths[j]);
    }
    out += line + "\n";
  }
  return out;
}

Json json(const StabilityRange& range, const std::string& symbol) {
  Json json;
  json["parameter"] = symbol;
  json["stable"] = Json::array();
  const auto value = [&](const std::optional<std::size_t>& bound) {
    return bound ? Json(range.bounds[*bound].value()) : Json();
  };
  const auto exact = [&](const std::optional<std::size_t>& bound) {
    return bound && !range.bounds[*bound].closed_form.empty()
               ? Json(range.bounds[*bound].closed_form)
               : Json();
  };
  for (const StablePiece& piece : stablePieces(range)) {
    json["stable"].push_back({{"from", value(piece.from)},
                              {"from_exact", exact(piece.from)},
                              {"from_included", piece.from_included},
                              {"to", value(piece.to)},
                              {"to_exact", exact(piece.to)},
                              {"to_included", piece.to_included}});
  }
  json["bounds"] = Json::array();
  for (std::size_t i = 0; i < range.bounds.size(); ++i) {
    const StabilityBound& bound = range.bounds[i];
    json["bounds"].push_back({{"value", bound.value()},
                              {"exact", exact(i)},
                              {"root_of", text(bound.of, symbol)},
                              {"degree_falls", bound.degree_falls},
                              {"root_at_zero", bound.root_at_zero},
                              {"pair", bound.pair_on_axis},
                              {"frequency", bound.frequency},
                              {"there", bound.there ? routhCountsJson(*bound.there) : Json()}});
  }
  json["intervals"] = Json::array();
  for (const StabilityInterval& interval : range.intervals) {
    Json one{{"from", value(interval.from)}, {"to", value(interval.to)}};
    one.update(routhCountsJson(interval.routh));
    json["intervals"].push_back(one);
  }
  return json;
}

std::string text(const StabilityRange& range, const std::string& symbol) {
  const std::string pieces = joined(
      stablePieces(range),
      [&](const StablePiece& piece) { return pieceText(range, piece, symbol); }, ", and for ");
  std::string out =
      fmt::format("asymptotically stable for {}\n", pieces.empty() ? "no " + symbol : pieces);
  if (range.never) {
    out += fmt::format("  for every {} there is a root at 0, or a pair s, -s\n", symbol);
  }
  std::vector<std::pair<std::string, std::string>> lines;
  for (std::size_t i = 0; i < range.intervals.size(); ++i) {
    const RouthResult& routh = range.intervals[i].routh;
    lines.emplace_back(intervalText(range, range.intervals[i], symbol),
                       fmt::format("{}: {}", verdictText(routh.verdict), countsText(routh)));
    if (i < range.bounds.size()) {
      const StabilityBound& bound = range.bounds[i];
      std::string what = whyText(bound);
      what += bound.there ? fmt::format(": {}", countsText(*bound.there)) : "";
      what += bound.closed_form.empty() ? fmt::format("; root of {}", text(bound.of, symbol)) : "";
      lines.emplace_back(fmt::format("{} = {}", symbol, boundText(bound)), what);
    }
  }
  std::size_t width = 0;
  for (const auto& [where, what] : lines) {
    width = std::max(width, where.size());
  }
  for (const auto& [where, what] : lines) {
    out += fmt::format("    {:<{}}  {}\n", where, width, what);
  }
  return out;
}

}  // namespace whirl_twin
