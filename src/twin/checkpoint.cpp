#include "twin/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "messages/checksum.h"
#include "messages/input_error.h"
#include "scene/yaml_file.h"
#include "twin/durable_file.h"

namespace whirl_twin {

namespace {

constexpr int kTries = 3;  // to find the size of a state, which may change meanwhile

}  // namespace

bool takeCheckpoint(LiveTwin& twin, const LiveParameters& parameters,
                    const std::function<bool()>& wait, Checkpoint& out) {
  for (int i = 0; i < kTries; ++i) {
    StateImage image = StateImage::taking(out.twin.data(), out.twin.size());
    TwinCommand save;
    save.kind = TwinCommand::Kind::kSave;
    save.image = &image;
    if (!twin.send(save) || !wait()) {
      return false;
    }
    if (twin.answer().done && image.size() == out.twin.size()) {
      out.step = twin.answer().step;
      out.live.reset(parameters.saved());
      return true;
    }
    out.twin.resize(image.size());
  }
  return false;
}

void takeAtRest(LiveTwin& twin, const LiveParameters& parameters, Checkpoint& out) {
  out.twin = imageOf(twin.atRest());
  out.step = twin.twin().stepCount();
  out.live.reset(parameters.saved());
}

void resume(const Checkpoint& checkpoint, LiveTwin& twin, LiveParameters& parameters,
            const std::string& source) {
  bool paused = false;
  try {
    if (checkpoint.live["drives"]) {  // saved from a live twin
      parameters.resume(checkpoint.live);
      paused = checkpoint.live["paused"].as<bool>();
    }
  } catch (const YAML::Exception&) {
    throw InputError(fmt::format("{}: corrupt: the live changes cannot be read", source));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", source, error.what()));
  }
  restore(checkpoint, twin.atRest(), source);
  twin.restore(paused);
}

namespace {

constexpr const char* kKind = "whirl_twin checkpoint ";
constexpr int kFormat = 2;
constexpr int kFormerFormat = 1;         // with a different checksum
constexpr std::size_t kMaxReported = 5;  // differences

/// What bit-identical steps depend on besides.
std::string machine() {
  std::string text = fmt::format("{} bits, compiler {}", 8 * sizeof(void*), __VERSION__);
#if defined(__x86_64__)
  text += ", x86_64";
#if !defined(__clang__)
  if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0) {
    text += " with fused multiply-add";
  }
#endif
#elif defined(__aarch64__)
  text += ", aarch64";
#endif
  return text;
}

[[noreturn]] void refuse(const std::string& source, const std::string& why) {
  throw InputError(fmt::format("{}: {}", source, why));
}

/// The line at `at`; `at` advances to the next one.
std::string lineAt(const std::string& bytes, std::size_t& at) {
  const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
  std::string line = bytes.substr(at, end - at);
  at = std::min(end + 1, bytes.size());
  return line;
}

/// Format number of the first line.
int requireFormat(const std::string& line, const std::string& source) {
  const std::string kind = kKind;
  if (line.compare(0, kind.size(), kind) != 0) {
    refuse(source, "must be a checkpoint of a twin, found another file");
  }
  const std::string format = line.substr(kind.size());
  for (const int known : {kFormat, kFormerFormat}) {
    if (format == std::to_string(known)) {
      return known;
    }
  }
  refuse(source,
         fmt::format("must be a checkpoint of format {}, found format {:.20}", kFormat, format));
}

void requireWhole(const std::string& bytes, std::size_t at, int format, const std::string& promise,
                  const std::string& source) {
  const std::ptrdiff_t digits = format == kFormat ? 8 : 16;
  unsigned long long size = 0;
  unsigned long long sum = 0;
  const char* const end = promise.data() + promise.size();
  const auto first = std::from_chars(promise.data(), end, size);
  const bool read =
      first.ec == std::errc() && first.ptr != end &&
      std::from_chars(first.ptr + 1, end, sum, 16).ec == std::errc() &&
      promise == fmt::format("{} {:0{}x}", size, sum, digits);  // lower-case hex digits only
  if (!read) {
    refuse(source, "corrupt: the second line must be a size and a checksum");
  }
  if (bytes.size() - at != size) {
    refuse(source, fmt::format("truncated: must have {} bytes after its second line, found {}",
                               size, bytes.size() - at));
  }
  const char* const rest = bytes.data() + at;
  const std::uint64_t found = format == kFormat ? std::uint64_t{crc32c(rest, bytes.size() - at)}
                                                : fingerprint(rest, bytes.size() - at);
  if (found != sum) {
    refuse(source, fmt::format("corrupt: must have the checksum {:0{}x}, found {:0{}x}", sum,
                               digits, found, digits));
  }
}

void requireOrigin(const YAML::Node& head, const std::string& source) {
  const auto version = head["version"].as<std::string>();
  if (version != WHIRL_TWIN_VERSION) {
    refuse(source,
           fmt::format(
               "must be saved by whirl_twin {}, the version that resumes it, found whirl_twin {}",
               WHIRL_TWIN_VERSION, version));
  }
  const auto other = head["machine"].as<std::string>();
  if (other != machine()) {
    refuse(source, fmt::format("must be saved by a build and a processor of the same kind ({}), "
                               "found {}",
                               machine(), other));
  }
}

/// Takes an image of any size; empty if the state cannot be saved.
template <class Whose>
bool takeImage(Whose& whose, std::string& out) {
  StateImage measured = StateImage::taking(nullptr, 0);
  whose.exchange(measured);
  out.resize(measured.size());
  StateImage image = StateImage::taking(out.data(), out.size());
  whose.exchange(image);
  return image.sound();
}

template <class Whose>
void put(const std::string& bytes, Whose& whose, const std::string& source) {
  StateImage image = StateImage::putting(bytes.data(), bytes.size());
  whose.exchange(image);
  if (!image.sound() || image.size() != bytes.size()) {
    refuse(source, fmt::format("must be saved by this build, found another state layout ({} bytes)",
                               bytes.size()));
  }
}

}  // namespace

std::string bytesOf(const Checkpoint& checkpoint) {
  YAML::Node head;
  head["version"] = WHIRL_TWIN_VERSION;
  head["machine"] = machine();
  head["step"] = checkpoint.step;
  head["scene"] = checkpoint.scene;
  if (checkpoint.live.IsDefined()) {
    // Clone: inserting a tree into another one shares the memory of both, which would grow without
    // bound over repeated checkpoints.
    head["live"] = YAML::Clone(checkpoint.live);
  }
  head["twin"] = checkpoint.twin.size();
  std::string rest = YAML::Dump(head) + "\n";
  rest.push_back('\0');
  rest += checkpoint.twin;
  rest += checkpoint.observer;
  return fmt::format("{}{}\n{} {:08x}\n", kKind, kFormat, rest.size(),
                     crc32c(rest.data(), rest.size())) +
         rest;
}

Checkpoint checkpointOf(const std::string& bytes, const std::string& source) {
  std::size_t at = 0;
  const int format = requireFormat(lineAt(bytes, at), source);
  const std::string promise = lineAt(bytes, at);
  requireWhole(bytes, at, format, promise, source);
  try {
    const std::size_t end = std::min(bytes.find('\0', at), bytes.size() - 1);
    const YAML::Node head =
        readYamlText(bytes.substr(at, end - at), source, "a checkpoint", "a scene and a step");
    requireOrigin(head, source);
    Checkpoint checkpoint;
    checkpoint.scene = head["scene"].as<SceneLines>();
    checkpoint.step = head["step"].as<std::int64_t>();
    if (head["live"]) {
      checkpoint.live.reset(head["live"]);
    }
    if (checkpoint.live.IsDefined() && !checkpoint.live.IsMap() && !checkpoint.live.IsNull()) {
      refuse(source, "corrupt: the live changes cannot be read");
    }
    const auto size = head["twin"].as<std::size_t>();
    checkpoint.twin = bytes.substr(end + 1, size);
    checkpoint.observer = bytes.substr(std::min(end + 1 + size, bytes.size()));
    return checkpoint;
  } catch (const YAML::Exception&) {
    refuse(source, "corrupt: its header cannot be read");
  }
}

Checkpoint readCheckpoint(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    refuse(path, "must be a checkpoint of a twin, found no such file");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    refuse(path, fmt::format("cannot be read: {}", std::strerror(errno)));
  }
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return checkpointOf(bytes, path);
}

void writeCheckpoint(const std::string& path, const std::string& bytes) {
  DurableFile file(path);
  file.add(bytes);
  file.finish();
}

void requireScene(const Checkpoint& checkpoint, const SceneLines& scene,
                  const std::string& source) {
  const auto find = [](const SceneLines& lines, const std::string& key) {
    const auto line = lines.find(key);
    return line == lines.end() ? std::string("nothing") : line->second;
  };
  SceneLines all = scene;
  all.insert(checkpoint.scene.begin(), checkpoint.scene.end());
  std::string differences;
  std::size_t differ = 0;
  for (const auto& [key, unused] : all) {
    const std::string expected = find(scene, key);
    const std::string found = find(checkpoint.scene, key);
    if (expected != found && ++differ <= kMaxReported) {
      differences += fmt::format("\n  {}: expected {:.80}, found {:.80}", key, expected, found);
    }
  }
  if (differ > 0) {
    refuse(source,
           fmt::format(
               "must be saved from the same scene{}{}", differences,
               differ > kMaxReported ? fmt::format("\n  and {} more", differ - kMaxReported) : ""));
  }
}

std::string imageOf(Twin& twin) {
  std::string image;
  if (!takeImage(twin, image)) {
    throw InputError(
        "its state cannot be saved: a control law owns memory, and has no exchange() "
        "(controllers/controller_entry.h)");
  }
  return image;
}

std::string imageOf(Observer& observer) {
  std::string image;
  takeImage(observer, image);
  return image;
}

void restore(const Checkpoint& checkpoint, Twin& twin, const std::string& source) {
  put(checkpoint.twin, twin, source);
  if (twin.stepCount() != checkpoint.step) {
    refuse(source,
           fmt::format("corrupt: must be of step {}, found {}", checkpoint.step, twin.stepCount()));
  }
}

void restore(const Checkpoint& checkpoint, Observer& observer, const std::string& source) {
  if (!checkpoint.observer.empty()) {
    put(checkpoint.observer, observer, source);
  }
}

}  // namespace whirl_twin
