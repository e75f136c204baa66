// Explanation of a log of a control's axes, as text and as JSON.
#pragma once

#include <string>

#include "base/read_file.h"
#include "choices/control_gap.h"

namespace trunnion::report {

/// One JSON object of schema trunnion.diagnosis/1 with `"of": "control"`; lengths in um, positions
/// with program, line and block; the files read with their hashes.
std::string control_gap_json(const choices::ControlGap& gap, const std::vector<FileRead>& inputs);
std::string control_gap_text(const choices::ControlGap& gap);

/// The verdict with its size, in one sentence.
std::string verdict_sentence(const choices::ControlGap& gap);
/// "line 12 `G2 X1. ...`".
std::string place_words(const choices::GapPlace& place);
/// "X -100.0000 -> -100.2500 mm (sigma 0.0001)".
std::string number_words(const choices::FittedNumber& number);

}  // namespace trunnion::report
