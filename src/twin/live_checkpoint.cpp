#include "twin/live_checkpoint.h"

#include <fmt/format.h>

#include "messages/refusal.h"

namespace whirl_twin {

namespace {

constexpr int kTries = 3;  // to find how large a state is, which a change may change

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
    if (checkpoint.live["drives"]) {  // it was live
      parameters.resume(checkpoint.live);
      paused = checkpoint.live["paused"].as<bool>();
    }
  } catch (const YAML::Exception&) {
    throw Refusal(fmt::format("{}: corrupt: the live changes cannot be read", source));
  } catch (const Refusal& error) {
    throw Refusal(fmt::format("{}: {}", source, error.what()));
  }
  putBack(checkpoint, twin.atRest(), source);
  twin.putBack(paused);
}

}  // namespace whirl_twin
