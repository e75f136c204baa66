// A machine and a program made of a seed.
#pragma once

#include <string>

#include "base/random.h"

/// A setup file: any serial five-axis chain, axes anywhere, a control that is told the truth.
std::string random_machine(trunnion::SeededNoise& noise);
/// Moves, planes, tool centre point control, cycles, loops, calls. It may end in an alarm.
std::string random_program(trunnion::SeededNoise& noise);
