#include "twin/lockstep.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace whirl_twin {

namespace {

/// The last published step before a given one.
std::int64_t publishedBefore(std::int64_t step, std::int64_t every) {
  return ((step + every - 1) / every - 1) * every;
}

}  // namespace

Lockstep::Lockstep(StepBarrier& gate, Settings settings, std::int64_t start)
    : gate_(gate),
      settings_(std::move(settings)),
      gathering_(on()),
      published_(publishedBefore(start, settings_.every)) {
  for (const std::string& name : settings_.who) {
    Listener listener;
    listener.name = name;
    listener.acknowledged = published_;
    listeners_.push_back(listener);
  }
  if (on()) {
    gate_.hold(run_);
  }
}

Lockstep::Listener* Lockstep::find(const std::string& who) {
  const auto found = std::find_if(listeners_.begin(), listeners_.end(),
                                  [&](const Listener& one) { return one.name == who; });
  return found == listeners_.end() ? nullptr : &*found;
}

void Lockstep::see(const std::string& who, bool there, double now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Listener* const listener = find(who);
  if (listener == nullptr || listener->there == there) {
    return;
  }
  listener->there = there;
  if (!there) {
    return;
  }
  // It does not receive earlier publications.
  listener->known = true;
  listener->left_out = false;
  listener->acknowledged = published_;
  listener->since = now;
  gathering_ = gathering_ && !std::all_of(listeners_.begin(), listeners_.end(),
                                          [](const Listener& one) { return one.known; });
  handOut();
}

bool Lockstep::acknowledge(const std::string& who, std::int64_t step, double now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Listener* const listener = find(who);
  if (listener == nullptr || step > published_) {
    return false;
  }
  listener->left_out = false;
  if (step > listener->acknowledged) {
    listener->acknowledged = step;
    listener->since = now;
  }
  handOut();
  return true;
}

void Lockstep::published(std::int64_t step, bool restarted, double now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  run_ += restarted ? 1 : 0;
  for (Listener& listener : listeners_) {
    if (restarted) {
      listener.acknowledged = publishedBefore(step, settings_.every);
    }
    if (listener.acknowledged >= published_ || restarted) {
      listener.since = now;
    }
  }
  published_ = step;
  if (restarted) {
    handOut();
  }
}

bool Lockstep::holdsUp(const Listener& listener) const {
  return !listener.left_out && listener.known &&
         published_ >= listener.acknowledged + settings_.ahead * settings_.every;
}

/// Sets the barrier to the limit of the slowest subscriber.
void Lockstep::handOut() {
  if (!on() || gathering_) {
    return;
  }
  std::int64_t reach = std::numeric_limits<std::int64_t>::max();
  for (const Listener& listener : listeners_) {
    if (!listener.left_out) {
      reach = std::min(reach, listener.acknowledged + settings_.ahead * settings_.every);
    }
  }
  if (reach == std::numeric_limits<std::int64_t>::max()) {
    return gate_.open();
  }
  gate_.allow(run_, reach);
}

void Lockstep::leaveOut(const std::vector<std::string>& who) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const std::string& name : who) {
    if (Listener* const listener = find(name)) {
      listener->left_out = true;
    }
  }
  handOut();
}

template <class Is>
std::vector<std::string> Lockstep::namesOf(Is&& is) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> names;
  for (const Listener& listener : listeners_) {
    if (is(listener)) {
      names.push_back(listener.name);
    }
  }
  return names;
}

std::vector<std::string> Lockstep::overdue(double now) const {
  return waitsFor(now, settings_.timeout);
}

std::vector<std::string> Lockstep::waitsFor(double now, double patience) const {
  return namesOf([&](const Listener& one) { return holdsUp(one) && now - one.since > patience; });
}

std::vector<std::string> Lockstep::leftOut() const {
  return namesOf([](const Listener& one) { return one.left_out; });
}

bool Lockstep::gathers() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return gathering_;
}

std::vector<std::string> Lockstep::missing() const {
  return namesOf([](const Listener& one) { return !one.there; });
}

}  // namespace whirl_twin
