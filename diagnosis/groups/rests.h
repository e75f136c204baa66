// What models of one design leave of the readings, and what of it may hide in
// them: where keys are searched.
#pragma once

#include <map>

#include "diagnosis/groups/key_search.h"
#include "diagnosis/prepare/prepare.h"
#include "diagnosis/search/search.h"

namespace trunnion::diagnosis {

class Rests {
  public:
    Rests(const Prepared& prepared, Design& design, KeySearch& keys)
        : prepared_(prepared), design_(design), keys_(keys) {}

    struct Rest {
        Eigen::VectorXd mm;
        KeySearch::Remainder remainder;
    };
    Rest of(const Model& model);
    KeySearch& keys() { return keys_; }

  private:
    Eigen::MatrixXd fitted_mm(const Model& model);

    const Prepared& prepared_;
    Design& design_;
    KeySearch& keys_;
    std::map<std::size_t, Eigen::MatrixXd> columns_mm_;  ///< of causes that were members
};

}  // namespace trunnion::diagnosis
