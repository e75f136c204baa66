// Which way the tool goes, relative to the work, when an axis counts up.
#pragma once

#include "kinematics/chain.h"

namespace trunnion::kinematics {

/// For X, Y and Z: +1 where a + command moves the tool along + of M relative to the work (ISO 841),
/// -1 where it moves against it. +1 for an axis that the chain has not.
Vector3 tool_senses(const Chain& chain);

}  // namespace trunnion::kinematics
