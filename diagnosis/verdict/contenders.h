// What a claim must stand against: the best model that does without its cause, found by the same
// search with as many other members as it takes. A single rival in its place is not enough: a free
// form is imitated by two causes (an angular error, seen through one tool length, by a straightness
// and its bow), or by one beside other sizes of the rest.
#pragma once

#include <cmath>

#include "diagnosis/search/heldout.h"

namespace trunnion::diagnosis {

/// Where models are compared, and with which belief in the noise.
struct Searching {
    Design& design;
    const SearchSetting& setting;
};

/// The best model found without a cause, against the chosen model with it.
struct Contender {
    Model model;
    double ahead = -HUGE_VAL;  ///< its evidence minus that of the chosen model, nats
    /// Log likelihood of left-out readings, chosen model minus contender, and the standard
    /// deviation of this sum that the scatter of the blocks implies, nats.
    double predicted = 0.0, spread = 0.0;
};

/// Probability of the chosen model against the contender, if other blocks had been measured: the
/// mean over what they would say, a normal distribution of the log odds.
double probability_against(const Contender& contender);

struct Challenged {
    Model model;
    std::vector<Contender> contenders;  ///< of each member; without a model for what is no cause
    /// Of a free form that is not sure: the best model without any free form of its axis.
    std::vector<Contender> of_axis;
    bool ended = false;  ///< the search was ended before the contenders were found
};
/// A model of which no cause is questioned: its search was ended.
Challenged unchallenged(Model model);
/// Contenders of all causes of a model. One that is better by its evidence, and not worse on
/// left-out readings, becomes the model.
Challenged challenged(FoldColumns& rows, const SearchSetting& setting, Model model);

}  // namespace trunnion::diagnosis
