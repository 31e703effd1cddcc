// A PD law in a process of its own, by LCM: u = -(kp y + kd y'), the derivative a backward
// difference. pd_by_lcm CHANNEL RATE KP KD [URL], CHANNEL without its ending: TWIN_PD; RATE [Hz]
// that of the scene. The law is that of the built-in pid, in the same order of operations.
#include <cstdlib>
#include <iostream>
#include <lcm/lcm-cpp.hpp>
#include <string>
#include <vector>
#include <whirl_twin/controller_command_t.hpp>
#include <whirl_twin/controller_measurement_t.hpp>

class Pd {
 public:
  Pd(lcm::LCM& lcm, std::string channel, double rate, double kp, double kd)
      : lcm_(lcm),
        command_(channel + "_COMMAND"),
        slope_gain_(1.0 / (1.0 / rate)),
        kp_(kp),
        kd_(kd) {
    lcm.subscribe(channel + "_SAMPLE", &Pd::take, this)->setQueueCapacity(1000);
  }

 private:
  void take(const lcm::ReceiveBuffer*, const std::string&,
            const whirl_twin::controller_measurement_t* measurement) {
    const std::vector<double>& y = measurement->values;
    // The first, or the first after a reset: none before it. A damaged one may have any length.
    if (measurement->run != run_ || y.size() != last_.size()) {
      run_ = measurement->run;
      last_ = y;
    }
    whirl_twin::controller_command_t command{};
    command.utime = measurement->utime;
    command.controller = measurement->controller;
    command.sample = measurement->sample;
    command.time = measurement->time;
    command.count = measurement->count;
    command.run = measurement->run;
    for (std::size_t i = 0; i < y.size(); ++i) {
      command.values.push_back(kp_ * (0.0 - y[i]) - kd_ * (slope_gain_ * (y[i] - last_[i])));
    }
    last_ = y;
    lcm_.publish(command_, &command);
  }

  lcm::LCM& lcm_;
  std::string command_;
  double slope_gain_, kp_, kd_;
  std::int64_t run_ = -1;
  std::vector<double> last_;
};

int main(int argc, char** argv) {
  if (argc < 5) {
    std::cerr << "usage: pd_by_lcm CHANNEL RATE KP KD [URL]\n";
    return 2;
  }
  lcm::LCM lcm(argc > 5 ? argv[5] : "");
  if (!lcm.good()) {
    std::cerr << "pd_by_lcm: LCM does not open\n";
    return 1;
  }
  const Pd pd(lcm, argv[1], std::atof(argv[2]), std::atof(argv[3]), std::atof(argv[4]));
  while (lcm.handle() == 0) {
  }
  return 1;
}
