#include "integration/acceleration_jacobian.h"

namespace whirl_twin {

template AccelerationJacobian<1> accelerationJacobian(const FixedLinearization<1>&) noexcept;
template AccelerationJacobian<2> accelerationJacobian(const FixedLinearization<2>&) noexcept;
template AccelerationJacobian<3> accelerationJacobian(const FixedLinearization<3>&) noexcept;
template AccelerationJacobian<4> accelerationJacobian(const FixedLinearization<4>&) noexcept;

}  // namespace whirl_twin
