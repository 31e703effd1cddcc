// Integration methods and their properties known before a run.
//
// Which engine steps which system, and why (docs/architecture.md has the same table):
//
//     what the model is                               integrator       engine
//     ----------------------------------------------------------------------------------------
//     energies, nonlinear: pendulums, free_rotor,     any but          SteppedSystem<Model, Method>
//     a rotor with hysteresis, rub, motor or films    exponential
//         Method and energies are one function after compiling, where `auto` may take the method;
//         others are type-erased (erased_system.h). `auto` calibrates. Multistep history
//         (stoermer) is discarded at breakpoints, commands and changes. MacroStep takes
//         one macro-step for many of the twin's steps without external input (stoermer_ahead).
//
//     energies, linear, of two coordinates:           exponential      LateralRotorStepper
//     jeffcott_rotor
//         Two oscillators that the shaft drives and couples. At constant speed the plain exact
//         step, the forces turned from step to step with the shaft; in a run-up 4, 8 or 12 Gauss
//         nodes at the drive's exact angle, as many as the step needs, in SIMD vectors.
//         Very stiff ones (more than 640 rad a step) use LinearRotorStepper.
//
//     energies, linear, without a shaft:              exponential      SteppedSystem<Model,
//     friction_oscillator                                                           Exponential>
//         e^(A h) of the state in one matrix of fixed size.
//
//     energies, linear, of more coordinates:          exponential      LinearRotorStepper
//     rigid_disc_rotor                                                 (RotorStep)
//         e^(A(w) h) from a table over the drive's speeds, so that run-ups are exact too but for
//         (a h^2)^2. withExactRunUps() puts either in Exponential's place.
//
//     rigid_disc_rotor, frame: rotating               exponential at   SteppedSystem<Model, Method>
//                                                     constant speed
//         The table is one of the fixed frame. On a drive any other method; `auto` calibrates.
//
//     energies, linear, any of the above, with        exponential      LinearRotorStepper
//     inputs                                                           (RotorStep)
//         The inputs are columns of its matrices, as they are of LinearStepper's
//         (applied_inputs.h). With any other method they are a generalized force (input_force.h).
//
//     energies, linear, any of the above              any other        SteppedSystem<Model, Method>
//         On request: comparison, `twin tradeoff`.
//
//     energies, with dry friction that can stick       any              SteppedSystem<ErasedModel,
//                                                                                    Method>
//         Sub-steps between start and end of sliding (dry_friction_step.h); no macro-steps.
//
//     matrices as functions of speed, of any size:    exponential,     LinearRotorStepper
//     flexible_rotor; any rotor on magnets            no other         (RotorStep)
//         Too many coordinates for fixed sizes. linearRotorSetup(). Nonlinear nodal forces
//         are solved for in addition (forced_rotor_step.h).
//
//     energies, a linear part and forces at           exponential      LinearRotorStepper
//     places: jeffcott_rotor in journal bearings                       (ForcedRotorStep)
//         The same of a rotor whose energies other methods step: withExactLinearPart().
//
//     matrices as functions of speed, on a motor:     exponential,     SpinningRotorStepper
//     flexible_rotor                                  no other         (ForcedRotorStep)
//         The whirl as in a run-up, along a course of the speed that is found with it
//         (shaft_spin.h): spinningRotorSetup().
//
//     matrices and harmonic forces: linear_system,    any but          LinearStepper
//     cantilever_beam, hinged_beam (geometry: small)  stoermer         (LinearStep)
//         Every method is linear here: one matrix, made once (linear_methods.h). linearSetup().
//
//     an ensemble of isotropic rotors, constant       exponential      IsotropicRotors
//     matrices, on a drive or at constant speed
//         One complex number a rotor, in SIMD vectors; the shaft's forces are evaluated
//         once for all. Not where a step has very many sub-steps (ensemble_members.cpp).
//
//     an ensemble of 12 or more pendulums or          runge_kutta_4,   BatchRungeKutta
//     mechanisms, without inputs                      dormand_prince_8
//         Energies, parameters and states of 32 systems in one loop, which compilers
//         vectorize (batched_models.cpp).
//
//     any other ensemble                              its system's     its system's, one by one
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace whirl_twin {

struct StepMethod {
  std::string name;  ///< as in scene files
  int order;         ///< of the global error in the step; 0: no truncation error
  bool implicit;
  bool symplectic;  ///< bounded energy error over any time without damping
  bool a_stable;    ///< no limit to the step of a system that is itself stable
  /// Forces that depend on the rates enter at rates that were predicted or are not yet known:
  /// gyroscopic and rotating-damping terms can then make the motion grow.
  bool predicts_rates;
  /// Evaluations of the accelerations in a step; of an implicit method, that of its usual number of
  /// iterations. Where they are not what a step takes, as many as take its time (a stage of
  /// runge_kutta_4 being one).
  double evaluations;
  /// Steps of history that it requires before it runs as the named method.
  std::size_t past = 0;
  /// The `substeps` of a system count the twin's steps in one of the method's, not the reverse.
  bool ahead = false;
  /// Only when requested by name: no calibration selects it.
  bool by_name = false;

  /// Its steps in one of the twin.
  double stepsFor(int substeps) const { return ahead ? 1.0 / substeps : substeps; }
};

/// All of them, from the lowest order to the exact step.
const std::vector<StepMethod>& stepMethods();

/// Throws std::logic_error for an unknown name.
const StepMethod& stepMethod(const std::string& name);

/// "2 a step", "one for 16 steps": those of a method, in words.
std::string stepsText(const std::string& integrator, int substeps);

}  // namespace whirl_twin
