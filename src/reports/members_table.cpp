#include "reports/members_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "messages/csv_cell.h"
#include "messages/refusal.h"
#include "reports/output.h"

namespace whirl_twin {

void writeMembers(const Twin& twin, const std::vector<std::size_t>& systems,
                  const std::string& path) {
  const auto system = std::find_if(systems.begin(), systems.end(),
                                   [&](std::size_t i) { return twin.ensemble(i) != nullptr; });
  const Ensemble& ensemble = *twin.ensemble(*system);
  std::string text = "member";
  for (const Spread& spread : twin.systems()[*system]->spec.ensemble.spread) {
    text += "," + csvCell(spread.path);
  }
  for (const EnsembleQuantity& q : ensemble.quantities()) {
    text += fmt::format(",{0},{0}_peak", q.name);
  }
  const std::size_t quantities = ensemble.quantities().size();
  std::vector<double> record(ensemble.recordSize());
  ensemble.write(twin.stepCount(), record.data());
  const double* const values = ensemble.values(record.data());
  const double* const peaks = ensemble.peaks(record.data());
  for (std::size_t i = 0; i < ensemble.count(); ++i) {
    text += fmt::format("\n{}", i);
    for (const double value : ensemble.drawn(i)) {
      text += fmt::format(",{:.17g}", value);
    }
    for (std::size_t k = 0; k < quantities; ++k) {
      text +=
          fmt::format(",{:.17g},{:.17g}", values[i * quantities + k], peaks[i * quantities + k]);
    }
  }
  PendingFile pending(path);
  std::ofstream file(pending.path(), std::ios::binary);
  file << text << '\n';
  file.close();
  if (!file) {
    throw RunFailure(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
  }
  pending.complete();
}

}  // namespace whirl_twin
