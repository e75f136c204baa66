// A diagnosis in words, in workshop units.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"
#include "report/shop_value.h"

namespace trunnion::report {

/// A size that is named _um: "12.3 µm", or in µrad where all readings are angles.
std::string size_words(const diagnosis::Diagnosis& d, double size);
/// "C.backlash", "C.backlash since friday"; of two causes of one name "Y.straightness as a table"
/// is the one in free form, of two in free form each has its errors: "free form of X (EXX)".
std::string cause_name(const diagnosis::Diagnosis& d, const diagnosis::Cause& cause);
/// Probable enough to be said; others are only listed.
bool is_claimed(const diagnosis::Cause& cause);
/// Words for a claimed cause that the setup of `--out` lacks although it has others; else empty.
std::string missing_in_setup(const diagnosis::Diagnosis& d, const diagnosis::Cause& cause);
/// "beside the causes the written setup has small errors ..."; empty where it has none.
std::string background_words(const diagnosis::Diagnosis& d);
/// Effects that the readings do not determine, without those that are a cause or a rival of one.
std::vector<std::string> unseen_effects(const diagnosis::Diagnosis& d);
/// "-27 to 43"; a lower end below -100 tells only that the gap may grow: "at most 44; ..".
std::string interval_words(const diagnosis::HeldOut& heldout, const char* unit = "");
/// True of a claimed cause none of whose values is twice its sigma.
bool is_sure_only_together(const diagnosis::Cause& cause);
/// True where the gap is nothing but the readings that were set aside: no cause explains or leaves
/// anything of the others.
bool is_only_spoiled(const diagnosis::Diagnosis& diagnosis);

/// A cause whose rivals are rather it: nothing is advised for it.
bool is_improbable(const diagnosis::Cause& cause);
/// How a cause stands to its rivals: "cannot be told apart here from", or what an improbable one
/// is.
const char* rivals_words(const diagnosis::Cause& cause);
/// The verdict with its size, in one sentence.
std::string verdict_sentence(const diagnosis::Diagnosis& diagnosis);
/// The answer in two or three sentences: size, causes, and reduction of the gap.
std::string answer(const diagnosis::Diagnosis& diagnosis);
/// Source of the noise estimate.
std::string noise_words(const diagnosis::Diagnosis& diagnosis);
std::string upper_first(std::string text);

}  // namespace trunnion::report
