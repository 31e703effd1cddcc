// Where a rotor whirls, ten times a second, from LCM: its speed, its radius, its lag behind the
// unbalance. whirl_by_lcm CHANNEL [URL], TWIN_ROTOR_WHIRL say.
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <string>
#include <whirl_twin/whirl_state_t.hpp>

constexpr int kEvery = 100;  // steps
constexpr double kDegrees = 57.29577951308232;

struct Display {
  void show(const lcm::ReceiveBuffer*, const std::string&, const whirl_twin::whirl_state_t* state) {
    if (state->step % kEvery != 0) {
      return;
    }
    std::printf("%.3f s  %.3f rad/s  %.5f mm  ", state->time, state->speed, 1e3 * state->radius);
    state->phase_valid ? std::printf("%.2f deg\n", kDegrees * state->phase)
                       : std::printf("- deg\n");
    std::fflush(stdout);
  }
};

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fputs("usage: whirl_by_lcm CHANNEL [URL]\n", stderr);
    return 2;
  }
  lcm::LCM lcm(argc > 2 ? argv[2] : "");
  if (!lcm.good()) {
    std::fputs("whirl_by_lcm: LCM does not open\n", stderr);
    return 1;
  }
  Display display;
  lcm.subscribe(argv[1], &Display::show, &display)->setQueueCapacity(1000);
  while (lcm.handle() == 0) {
  }
  return 1;
}
