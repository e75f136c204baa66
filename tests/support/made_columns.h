// Made-up columns of causes, where it is known what can be told apart.
#pragma once

#include <string>

#include "base/random.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/verdict/claims.h"

namespace trunnion::made_columns {

constexpr int rows = 400, blocks = 80;

inline Eigen::MatrixXd random_matrix(SeededNoise& random, Eigen::Index columns) {
    Eigen::MatrixXd m(rows, columns);
    for (Eigen::Index c = 0; c < columns; ++c)
        for (Eigen::Index r = 0; r < rows; ++r) m(r, c) = random.normal();
    return m;
}

inline const effects::Effect& straightness_of_Z() {
    static const effects::Effect effect{
        {"Z.straightness", effects::EffectKind::straightness, Axis::Z}, "", "", "", "", {}, {}};
    return effect;
}

inline diagnosis::ColumnGroup group_of(diagnosis::Design& design, const std::string& name,
                                       diagnosis::GroupKind kind, const Eigen::MatrixXd& columns) {
    diagnosis::ColumnGroup group;
    group.kind = kind;
    group.name = name;
    group.log_prior = diagnosis::rules::effect_prior;
    if (kind == diagnosis::GroupKind::textbook) group.effect = &straightness_of_Z();
    group.table.motion = effects::EffectKind::straightness;
    group.table.axis.axis = name[0] == 'Z' ? Axis::Z : Axis::X;
    group.table.axis.name = name.substr(0, 1);
    const Eigen::Index first = design.add_features(columns);
    for (Eigen::Index k = 0; k < columns.cols(); ++k) group.features.push_back(first + k);
    return group;
}

inline diagnosis::Folds folds_of_blocks() {
    diagnosis::Folds folds;
    for (int i = 0; i < rows; ++i) folds.group.push_back(i * blocks / rows);
    for (int b = 0; b < blocks; ++b) folds.fold.push_back(b % diagnosis::Folds::count);
    return folds;
}

}  // namespace trunnion::made_columns
