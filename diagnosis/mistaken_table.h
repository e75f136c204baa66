// A table whose columns do not hold what they say: exchanged, turned in sign, in another unit
// (mistaken_table.cpp).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "diagnosis/diagnosis.h"
#include "diagnosis/round.h"

namespace trunnion::diagnosis {

struct MistakenTable {
    std::string words;     ///< a sentence
    bool certain = false;  ///< no machine explains the readings as well as this does
};

/// False: the work is to end.
using GoOn = std::function<bool()>;

struct SearchResult {
    Design& design;
    const Model& model;
    double noise = 1.0;  ///< expected of the readings, in sigma: not 1 where neighbours tell it
    GoOn go_on = {};
};

/// The simple change of a table (two columns exchanged, a sign turned, mm for inches, ..) that
/// explains nearly everything: with it the set-up alone leaves much less than it leaves now, and
/// the evidence of a search among causes in the table put right is above that of the causes found
/// in it as it stands, by the odds against a mistake (of a unit: not below). Not certain where
/// causes of usual size leave the noise alone. Only looked for where the set-up alone is far from
/// the readings.
std::optional<MistakenTable> mistaken_table(const Prepared& prepared, const SearchResult& found,
                                            const std::vector<bool>& used);

/// The same for a table that is refused, because the set-up leaves residuals of no machine.
std::optional<MistakenTable> mistaken_table(const setup::Setup& setup,
                                            const records::ReadingTable& table, const GoOn& go_on);

/// No cause is sure beside a table that may be mistaken.
void tell_mistaken(const MistakenTable& mistaken, Diagnosis& diagnosis);

}  // namespace trunnion::diagnosis
