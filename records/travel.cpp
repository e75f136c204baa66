#include "records/travel.h"

#include <cmath>

#include "base/units.h"

namespace trunnion::records {

const Rounding rows_rounding{1.5e-6, rad_from_deg(1.5e-6)};

TravelHistory::TravelHistory(const AxisSides& before, const Rounding& rounding,
                             const AxisNames& names)
    : side_(before) {
    for (std::size_t i = 0; i < axis_count; ++i)
        rounding_[i] = names.rotary[i] ? rounding.rad : rounding.mm;
}

void TravelHistory::place(const AxisPositions& position) {
    last_ = turned_at_ = position;
    placed_ = true;
    begin_anew();
}

void TravelHistory::begin_anew() {
    direction_.fill(0);
    turned_.fill(false);
    run_up_unknown_.fill(false);
    turned_at_ = last_;
}

void TravelHistory::assume_turned(std::size_t axis) {
    turned_[axis] = run_up_unknown_[axis] = true;
    turned_at_.value[axis] = last_.value[axis];
}

void TravelHistory::advance(std::size_t axis, double value, const double* turned_at) {
    const double step = value - last_.value[axis];
    just_turned_[axis] = false;
    if (std::abs(step) < rounding_[axis]) return;
    const signed char sign = step > 0.0 ? 1 : -1;
    if (direction_[axis] == -sign) {
        turned_[axis] = just_turned_[axis] = true;
        run_up_unknown_[axis] = false;
        turned_at_.value[axis] = turned_at ? *turned_at : last_.value[axis];
    }
    direction_[axis] = side_[axis] = sign;
    last_.value[axis] = value;
}

void TravelHistory::advance(const AxisPositions& position, const AxisPositions* turned_at) {
    if (!placed_) return place(position);
    for (std::size_t i = 0; i < axis_count; ++i)
        advance(i, position.value[i], turned_at ? &turned_at->value[i] : nullptr);
}

void TravelHistory::describe(AxisSample& sample) const {
    sample.travel = side_;
    sample.run_up_unknown = run_up_unknown_;
    for (std::size_t i = 0; i < axis_count; ++i)
        sample.since_reversal[i] = std::abs(last_.value[i] - turned_at_.value[i]) +
                                   (turned_[i] ? 0.0 : no_reversal_seen + 1.0);
}

}  // namespace trunnion::records
