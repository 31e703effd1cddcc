#include "transport/lcm_converters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <type_traits>
#include <vector>

#include "state_samples.h"

namespace whirl_twin {
namespace lcm_converters_test {

TEST(LcmConverters, BringEveryBitBack) {
  StateSamples samples(1);
  for (int i = 0; i < 300; ++i) {
    samples.each([](const auto& state) {
      using State = std::decay_t<decltype(state)>;
      EXPECT_EQ(bitsOf(fromLcm<State>(toLcm(state))), bitsOf(state)) << State::kKind.name;
    });
  }
}

TEST(LcmConverters, UtimeIsTheSimulatedTimeInMicroseconds) {
  state::WhirlState whirl;
  whirl.system = "rotor";
  whirl.at = {1000001, 1000.001, 1234567890123456789};
  const auto message = toLcm(whirl);
  EXPECT_EQ(message.utime, 1000001000);
  EXPECT_EQ(message.stamp, 1234567890123456789);
  EXPECT_EQ(message.step, 1000001);
  whirl.at.time = std::nan("");
  EXPECT_EQ(toLcm(whirl).utime, 0);
}

TEST(LcmConverters, AnInstabilitySpeedThatWasNotFoundIsNotValid) {
  auto margin = StateSamples(2).margin();
  margin.instability_speed = std::nan("");
  EXPECT_FALSE(toLcm(margin).instability_speed_valid);
  margin.instability_speed = 120.0;
  EXPECT_TRUE(toLcm(margin).instability_speed_valid);
}

/// Ways to spoil a message that its receiver must notice.
template <class Type>
using Spoilers = std::vector<std::function<void(Type&)>>;

template <class State, class Type>
void expectRejectedAs(const Type& good, const Spoilers<Type>& spoilers) {
  ASSERT_NO_THROW(fromLcm<State>(good));
  for (std::size_t i = 0; i < spoilers.size(); ++i) {
    Type message = good;
    spoilers[i](message);
    EXPECT_THROW(fromLcm<State>(message), RejectedMessage)
        << Type::getTypeName() << " spoiler " << i;
  }
}

/// The kind is found by its LCM type.
template <class Type>
void expectRejected(const Type& good, const Spoilers<Type>& spoilers) {
  eachKind([&](auto kind) {
    using State = typename decltype(kind)::State;
    if constexpr (std::is_same_v<LcmType<State>, Type>) {
      expectRejectedAs<State>(good, spoilers);
    }
  });
}

template <class Message>
Spoilers<Message> instantSpoilers() {
  return {[](Message& m) { m.step = -1; },
          [](Message& m) { m.time = std::nan(""); },
          [](Message& m) { m.time = INFINITY; },
          [](Message& m) { m.time += 1.0; },
          [](Message& m) { m.utime += 1; },
          [](Message& m) { m.stamp = -1; },
          [](Message& m) { m.stamp = kMaxStamp + 1; }};
}

/// A name no system or drive can have.
const std::vector<std::string> kNoNames{"",
                                        "2nd",
                                        "_x",
                                        "a b",
                                        "a/b",
                                        "~x",
                                        "r\xc3\xb6tor",
                                        "\xff\xfe",
                                        std::string("a\0b", 3),
                                        std::string(kMaxNameLength + 1, 'a'),
                                        "a\n"};

TEST(LcmConverters, RejectNamesThatAreNone) {
  StateSamples samples(3);
  for (const auto& name : kNoNames) {
    expectRejected<whirl_state_t>(toLcm(samples.whirl()), {[&](auto& m) { m.system = name; }});
    expectRejected<drive_state_t>(toLcm(samples.drive()), {[&](auto& m) { m.drive = name; }});
    expectRejected<pendulum_state_t>(toLcm(samples.pendulum()),
                                     {[&](auto& m) { m.system = name; }});
    expectRejected<motor_state_t>(toLcm(samples.motor()), {[&](auto& m) { m.drive = name; },
                                                           [&](auto& m) { m.system = name; }});
    expectRejected<ensemble_state_t>(
        toLcm(samples.ensemble()),
        {[&](auto& m) { m.system = name; }, [&](auto& m) { m.quantity[0] = name; }});
    expectRejected<parameter_change_t>(
        toLcm(samples.change()),
        {[&](auto& m) { m.system = name; }, [&](auto& m) { m.names[0] = name; },
         [&](auto& m) { m.changed[0] = name; }});
    expectRejected<alert_t>(toLcm(samples.alert()),
                            {[&](auto& m) { m.system = name; }, [&](auto& m) { m.type = name; }});
    expectRejected<stability_margin_t>(
        toLcm(samples.margin()),
        {[&](auto& m) { m.system = name; }, [&](auto& m) { m.model = name; },
         [&](auto& m) { m.verdict_name = name; }});
  }
}

TEST(LcmConverters, RejectImpossibleWhirlsAndDrives) {
  StateSamples samples(4);
  const auto whirl = toLcm(samples.whirl());
  expectRejected(whirl, instantSpoilers<whirl_state_t>());
  expectRejected<whirl_state_t>(
      whirl, {[](auto& m) { m.phase_valid = 2; }, [](auto& m) { m.forward = -1; }});
  expectRejected(toLcm(samples.drive()), instantSpoilers<drive_state_t>());
  expectRejected(toLcm(samples.motor()), instantSpoilers<motor_state_t>());
}

TEST(LcmConverters, RejectPendulumsWhoseArraysDiffer) {
  state::PendulumState pendulum;
  pendulum.system = "arm";
  pendulum.name = {"theta1", "theta2"};
  pendulum.angle = {0.1, 0.2};
  pendulum.rate = {1.0, 2.0};
  const auto message = toLcm(pendulum);
  expectRejected(message, instantSpoilers<pendulum_state_t>());
  expectRejected<pendulum_state_t>(
      message, {[](auto& m) { m.coordinates = -1; }, [](auto& m) { m.coordinates = 1; },
                [](auto& m) { m.name.pop_back(); }, [](auto& m) { m.angle.pop_back(); },
                [](auto& m) { m.rate.push_back(0.0); }, [](auto& m) { m.name[1] = ""; }});
}

TEST(LcmConverters, RejectEnsemblesThatCannotBeMeant) {
  state::EnsembleState ensemble;
  eachMember(ensemble, [](const char*, auto& field, Stays) {
    if constexpr (std::is_same_v<std::decay_t<decltype(field)>, std::vector<double>>) {
      field = {1.0, 2.0};
    }
  });
  ensemble.system = "arm";
  ensemble.count = 50;
  ensemble.running = 50;
  ensemble.quantity = {"theta", "slide"};
  ensemble.unit = {"rad", "m"};
  const auto message = toLcm(ensemble);
  expectRejected(message, instantSpoilers<ensemble_state_t>());
  expectRejected<ensemble_state_t>(
      message, {[](auto& m) { m.count = 0; }, [](auto& m) { m.count = -50; },
                [](auto& m) { m.running = -1; }, [](auto& m) { m.running = 51; },
                [](auto& m) { m.quantities = -1; }, [](auto& m) { m.quantities = 1; },
                [](auto& m) { m.quantity.pop_back(); }, [](auto& m) { m.unit.pop_back(); },
                [](auto& m) { m.unit[0] = ""; }, [](auto& m) { m.unit[1] = "mm\x1b"; }});
  // A statistic is missing or has one entry too many, whichever it is.
  const auto statistics = [](ensemble_state_t& m) {
    return std::vector<std::vector<double>*>{
        &m.mean,          &m.standard_deviation, &m.smallest,
        &m.percentile_5,  &m.percentile_25,      &m.median,
        &m.percentile_75, &m.percentile_95,      &m.largest,
        &m.peak_mean,     &m.peak_median,        &m.peak_standard_deviation,
        &m.peak_largest,  &m.peak_percentile_5,  &m.peak_percentile_95};
  };
  for (std::size_t i = 0; i < 15; ++i) {
    expectRejected<ensemble_state_t>(message, {[&](auto& m) { statistics(m)[i]->pop_back(); },
                                               [&](auto& m) { statistics(m)[i]->push_back(0.0); }});
  }
}

TEST(LcmConverters, EnsemblesWithArraysOfTheWrongLengthAreFilledUp) {
  state::EnsembleState ensemble;
  ensemble.system = "rotor";
  ensemble.count = ensemble.running = 3;
  ensemble.quantity = {"radius"};
  ensemble.unit = {"m"};
  ensemble.mean = {1.0, 2.0};
  const auto message = toLcm(ensemble);
  EXPECT_EQ(message.mean, std::vector<double>{1.0});
  EXPECT_EQ(message.peak_largest, std::vector<double>{0.0});
  EXPECT_NO_THROW(fromLcm<state::EnsembleState>(message));
}

TEST(LcmConverters, RejectChangesOfParametersThatCannotBeMeant) {
  state::ParameterChange change;
  change.system = "rotor";
  change.names = {"mass", "discs[1].mass", "stiffness[0][1]"};
  change.values = {1.0, 2.0, 3.0};
  change.changed = {"mass"};
  change.previous = {0.5};
  const auto message = toLcm(change);
  expectRejected(message, instantSpoilers<parameter_change_t>());
  expectRejected<parameter_change_t>(
      message,
      {[](auto& m) { m.parameters = -1; }, [](auto& m) { m.parameters = 2; },
       [](auto& m) { m.names.pop_back(); }, [](auto& m) { m.values.pop_back(); },
       [](auto& m) { m.changes = 0; }, [](auto& m) { m.previous.push_back(0.0); },
       [](auto& m) { m.names[1] = "discs[1]/mass"; }, [](auto& m) { m.names[1] = "[1].mass"; },
       [](auto& m) { m.changed[0] = "mass\x1b"; },
       [](auto& m) { m.names[2] = "a[" + std::string(2 * kMaxNameLength, '1') + "]"; }});
}

TEST(LcmConverters, RejectImpossibleMargins) {
  state::StabilityMargin margin;
  margin.system = "rotor";
  margin.model = "jeffcott_rotor";
  margin.verdict_name = "unstable";
  margin.coordinate = {"x", "y"};
  margin.operating_point = {0.0, 0.0};
  margin.polynomial = {1.0, 2.0, 3.0};
  margin.first_column = {1.0, 2.0, 3.0};
  margin.right = 2;
  margin.critical_speeds.resize(1);
  margin.critical_speeds[0].direction = "forward";
  const auto message = toLcm(margin);
  expectRejected(message, instantSpoilers<stability_margin_t>());
  expectRejected<stability_margin_t>(
      message,
      {[](auto& m) { m.verdict = 5; }, [](auto& m) { m.verdict = -1; },
       [](auto& m) { m.coordinates = 3; }, [](auto& m) { m.operating_point.pop_back(); },
       [](auto& m) { m.coefficients = -3; }, [](auto& m) { m.rows = 2; },
       [](auto& m) { m.right = -1; }, [](auto& m) { m.left = 1000; },
       [](auto& m) { m.instability_speed_valid = 0; },
       [](auto& m) { m.instability_speed = std::nan(""); }, [](auto& m) { m.critical_speeds = 2; },
       [](auto& m) { m.band_low.clear(); }, [](auto& m) { m.direction[0] = "sideways"; }});
}

// Multipliers of a periodic motion have no polynomial: the verdict of a shaken pendulum that falls.
TEST(LcmConverters, TakeTheMarginOfAPeriodicMotion) {
  state::StabilityMargin margin;
  margin.system = "pendulum";
  margin.model = "kapitza_pendulum";
  margin.verdict = 3;
  margin.verdict_name = "unstable";
  margin.coordinate = {"theta"};
  margin.operating_point = {0.0};
  margin.right = margin.right_by_eigenvalues = 1;
  margin.left = 1;
  margin.instability_speed = std::nan("");
  auto message = toLcm(margin);
  EXPECT_EQ(bitsOf(fromLcm<state::StabilityMargin>(message)), bitsOf(margin));
  message.right = 3;
  EXPECT_THROW(fromLcm<state::StabilityMargin>(message), RejectedMessage);
}

TEST(LcmConverters, RejectLoopStatisticsThatCannotBeMeant) {
  auto loop = StateSamples(6).loop();
  loop.system = {"rotor", "arm"};
  loop.integrator = {"exponential", "runge_kutta_4"};
  loop.error_estimate = loop.tolerance = {1e-9, std::nan("")};
  loop.stopped = {0, 3};
  loop.stopped_why = {"", "speed not prepared for"};
  const auto message = toLcm(loop);
  expectRejected(message, instantSpoilers<loop_statistics_t>());
  expectRejected<loop_statistics_t>(
      message, {[](auto& m) { m.systems = 1; }, [](auto& m) { m.system[0] = "a b"; },
                [](auto& m) { m.stopped[1] = 6; }, [](auto& m) { m.stopped[1] = -1; },
                [](auto& m) { m.stopped_why.pop_back(); }, [](auto& m) { m.tolerance.clear(); },
                [](auto& m) { m.error_estimate.push_back(0.0); }, [](auto& m) { m.paused = 2; },
                [](auto& m) { m.overruns = -1; }, [](auto& m) { m.kernel = "\x1b[2J"; }});
}

TEST(LcmConverters, RejectMeasurementsThatCannotBeMeant) {
  state::Measurement measured;
  measured.source = "sensors";
  measured.channel = {"probe_x", "probe_y"};
  measured.unit = {"m", "m"};
  measured.deviation = {1e-6, std::nan("")};
  measured.samples = 2;
  measured.first_instant = 1000;
  measured.period = 500;
  measured.value = {1e-4, 0.0, 2e-4, std::nan("")};
  measured.valid = {1, 1, 1, 0};
  const auto message = toLcm(measured);
  expectRejected(message, instantSpoilers<measurement_t>());
  expectRejected<measurement_t>(
      message, {[](auto& m) { m.source = "a/b"; }, [](auto& m) { m.channel[1] = "probe x"; },
                [](auto& m) { m.channel[1] = m.channel[0]; }, [](auto& m) { m.unit.pop_back(); },
                [](auto& m) { m.deviation[0] = -1e-9; }, [](auto& m) { m.samples = 3; },
                [](auto& m) { m.samples = 0; }, [](auto& m) { m.samples = INT64_MAX; },
                [](auto& m) { m.period = 0; }, [](auto& m) { m.period = -500; },
                [](auto& m) { m.first_instant = INT64_MIN; }, [](auto& m) { m.valid[3] = 2; },
                [](auto& m) { m.valid.pop_back(); }, [](auto& m) { m.value.pop_back(); },
                [](auto& m) { m.values = 5; }, [](auto& m) { m.channels = 1; }});
}

TEST(LcmConverters, RejectWhatNoFollowerCanMean) {
  state::FollowState follow;
  follow.system = "rotor";
  follow.parameter = {"bearings[0].kxx", "mass"};
  follow.parameter_unit = {"N/m", "kg"};
  follow.value = {1e7, 2.0};
  follow.deviation = {1e4, std::nan("")};
  follow.channel = {"probes/probe_x", "probes/probe_y"};
  follow.channel_unit = {"m", "m"};
  follow.residual = {1e-6, std::nan("")};
  follow.residual_deviation = {2e-6, std::nan("")};
  follow.offset = {0.0, std::nan("")};
  follow.channel_status = {0, 1};
  follow.drift_parameter = "mass";
  follow.bearing = {"bearings[0]"};
  follow.force_x = {10.0};
  follow.force_y = {-2.0};
  follow.force_deviation = {1.0};
  const auto message = toLcm(follow);
  EXPECT_EQ(bitsOf(fromLcm<state::FollowState>(message)), bitsOf(follow));
  expectRejected(message, instantSpoilers<follow_state_t>());
  expectRejected<follow_state_t>(
      message,
      {[](auto& m) { m.system = "a/b"; }, [](auto& m) { m.parameter[0] = "k xx"; },
       [](auto& m) { m.parameter_unit.pop_back(); }, [](auto& m) { m.value.push_back(0.0); },
       [](auto& m) { m.deviation[0] = -1.0; }, [](auto& m) { m.channel[0] = "probe_x"; },
       [](auto& m) { m.channel[0] = "probes/"; }, [](auto& m) { m.channel[0] = "a/b/c"; },
       [](auto& m) { m.channel_status[0] = 4; }, [](auto& m) { m.channel_status[0] = -1; },
       [](auto& m) { m.residual_deviation[0] = -1e-9; }, [](auto& m) { m.mismatch = -1.0; },
       [](auto& m) { m.drift_parameter = "stiffness"; }, [](auto& m) { m.bearings = 2; },
       [](auto& m) { m.force_y.clear(); }, [](auto& m) { m.late = -1; },
       [](auto& m) { m.clock_offset_deviation = -1.0; }, [](auto& m) { m.shaft_known = 2; }});
}

TEST(LcmConverters, RejectPulsesThatAreNotInOrder) {
  state::Measurement pulses;
  pulses.source = "sensors";
  pulses.channel = {"keyphasor"};
  pulses.unit = {""};
  pulses.deviation = {0.0};
  pulses.samples = 3;
  pulses.first_instant = 1000;
  pulses.instant = {1000, 53600, 106100};
  pulses.value = {1.0, 1.0, 1.0};
  pulses.valid = {1, 1, 1};
  expectRejected<measurement_t>(
      toLcm(pulses),
      {[](auto& m) { m.instant[1] = 1000; }, [](auto& m) { m.instant[2] = 2000; },
       [](auto& m) { m.first_instant = 999; }, [](auto& m) { m.period = 1; },
       [](auto& m) { m.instant.pop_back(); }, [](auto& m) { m.instant[2] = INT64_MAX; }});
}

TEST(LcmConverters, RejectCommandsThatCannotBeMeant) {
  state::InputCommand command;
  command.system = "rotor";
  command.input = {"force_x", "force_y"};
  command.value = {1.0, -2.0};
  command.duration = 0.5;
  const auto message = toLcm(command);
  expectRejected(message, instantSpoilers<input_command_t>());
  expectRejected<input_command_t>(
      message, {[](auto& m) { m.system = "a/b"; }, [](auto& m) { m.input[0] = "force x"; },
                [](auto& m) { m.value[1] = std::nan(""); },
                [](auto& m) { m.value[0] = std::numeric_limits<double>::infinity(); },
                [](auto& m) { m.value.pop_back(); }, [](auto& m) { m.duration = 0.0; },
                [](auto& m) { m.duration = std::nan(""); }, [](auto& m) { m.inputs = 3; }});
}

TEST(LcmConverters, RejectCommandsToTheMonitorThatCannotBeMeant) {
  state::AlarmCommand command;
  command.command = state::AlarmCommand::kInhibit;
  command.duration = 60.0;  // of every system
  const auto message = toLcm(command);
  EXPECT_EQ(bitsOf(fromLcm<state::AlarmCommand>(message)), bitsOf(command));
  expectRejected(message, instantSpoilers<alarm_command_t>());
  expectRejected<alarm_command_t>(
      message, {[](auto& m) { m.command = 0; }, [](auto& m) { m.command = 4; },
                [](auto& m) { m.command = -1; }, [](auto& m) { m.system = "a b"; },
                [](auto& m) { m.type = "UN STABLE"; }, [](auto& m) { m.duration = -1.0; },
                [](auto& m) { m.duration = 3601.0; }, [](auto& m) { m.duration = std::nan(""); }});
}

TEST(LcmConverters, RejectImpossibleAlerts) {
  const auto alert = toLcm(StateSamples(5).alert());
  expectRejected<alert_t>(
      alert,
      {[](auto& m) { m.severity = 3; }, [](auto& m) { m.state = 2; },
       [](auto& m) { m.time = std::nan(""); }, [](auto& m) { m.raised_time = INFINITY; },
       [](auto& m) { m.utime -= 1; }, [](auto& m) { m.stamp = -1; },
       [](auto& m) { m.text = "\x1b[2J"; }, [](auto& m) { m.text = "\xc0\xaf"; },  // overlong
       [](auto& m) { m.text = "\xed\xa0\x80"; },  // half a surrogate
       [](auto& m) { m.text = "cut \xe2\x82"; },  // unfinished
       [](auto& m) { m.text = std::string(1001, 'a'); }});
}

}  // namespace lcm_converters_test
}  // namespace whirl_twin
