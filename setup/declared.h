// Digests of the declared geometry that readings of points are taken beside.
#pragma once

#include <map>
#include <string>

#include "setup/setup.h"

namespace trunnion::setup {

/// "chain", "target S1", "instrument tracker" and, for rows that name none, "instrument": twelve
/// digits each. What a fit finds (errors, poses, found positions) is no part of them.
std::map<std::string, std::string> declared_digests(const Setup& setup);

}  // namespace trunnion::setup
