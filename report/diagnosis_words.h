// A diagnosis in words and in the units of the shop.
#pragma once

#include <string>

#include "diagnosis/diagnosis.h"

namespace trunnion::report {

/// One parameter as the shop writes it: um and urad instead of mm and rad where they are small.
struct ShopValue {
    std::string name, value, sigma, unit;  ///< sigma "-" when it has none
};
ShopValue shop_value(const identification::FitParameter& parameter);

/// "gap 81.2 +- 0.9 urad": the parameter that stands out most from its uncertainty.
std::string main_size(const diagnosis::Cause& cause);
/// "C.backlash", "C.backlash since friday"
std::string cause_name(const diagnosis::Cause& cause);
/// The verdict with its size, in one sentence.
std::string verdict_sentence(const diagnosis::Diagnosis& diagnosis);
/// The whole answer in two or three plain sentences: how large, why, how far it would shrink.
std::string answer(const diagnosis::Diagnosis& diagnosis);
/// Where the noise figure comes from.
std::string noise_words(const diagnosis::Diagnosis& diagnosis);
std::string upper_first(std::string text);

}  // namespace trunnion::report
