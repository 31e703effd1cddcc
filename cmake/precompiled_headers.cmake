# Headers of others that most files include, read once a target instead of once a file. Files include what they use all
# the same: -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON builds without. Sources with options of their own cannot use them.
set(whirl_twin_common_headers
  <algorithm> <array> <cmath> <complex> <cstdint> <functional> <limits> <map> <memory> <optional> <string> <utility>
  <variant> <vector> <Eigen/Core> <fmt/format.h>)
