# The steps of the models, ours and those of plugins: here, and only here, the compiler may assume
# finite numbers, which lets it delete the terms of a dual number whose seeds are zero. Results are
# checked by their bits (src/integration/finite.h). Eigen's inverse() of 4 x 4 matrices relies on signed
# zeros and is wrong with these options.
set(whirl_twin_step_options
  -ffinite-math-only -fno-signed-zeros -fno-trapping-math -fno-math-errno)
