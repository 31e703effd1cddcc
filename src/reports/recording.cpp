#include "reports/recording.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "estimation/uff_file.h"
#include "messages/input_error.h"
#include "messages/message_check.h"

namespace whirl_twin {

namespace {

LoggedMessages readTable(const Recording& recording, const std::vector<EstimatorSource>& sources,
                         const TakeLogged& take, const LogProgress& advanced) {
  const ImportSettings settings =
      recording.import ? readImportSettings(*recording.import) : ImportSettings();
  TableImport table(recording.path, settings, sources);
  LoggedMessages log;
  std::error_code error;
  log.size = std::filesystem::file_size(recording.path, error);
  for (auto messages = table.next(); !messages.empty(); messages = table.next()) {
    advanced(table.offset(), table.size());
    for (const state::Measurement& message : messages) {
      try {
        take(message, message.lastInstant() / kMicrosecond);
        ++log.taken;
      } catch (const RejectedMessage&) {
        ++log.rejected;
      }
    }
  }
  log.remarks = table.remarks();
  return log;
}

}  // namespace

bool isTable(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension();
  for (const char* of_log : {".lcmlog", ".bag", ".active"}) {
    if (extension == of_log) {
      return false;
    }
  }
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error)) {
    return false;  // a pipe would wait for its writer
  }
  std::array<char, 1024> begin{};
  std::ifstream in(path, std::ios::binary);
  in.read(begin.data(), begin.size());
  const std::string text(begin.data(), static_cast<std::size_t>(in.gcount()));
  const bool is_log = text.rfind("\xed\xa1\xda\x01", 0) == 0 || text.rfind("#ROSBAG", 0) == 0;
  return !is_log && (extension == ".csv" || extension == ".txt" || extension == ".tsv" ||
                     isUffFile(path) || (!text.empty() && text.find('\0') == std::string::npos));
}

LoggedMessages readRecording(const Recording& recording,
                             const std::vector<EstimatorSource>& sources, const Kinds& kinds,
                             const TakeLogged& take, const LogProgress& advanced, LogOrder order) {
  if (isTable(recording.path)) {
    return readTable(recording, sources, take, advanced);
  }
  if (recording.import) {
    throw InputError("--import: needs a table, found a log: " + recording.path);
  }
  return readLoggedMessages(recording.path, recording.prefix, kinds, take, advanced, order);
}

}  // namespace whirl_twin
