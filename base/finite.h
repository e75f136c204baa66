// A number that is neither NaN nor infinite: the type of what a setup, a table, a fit or a
// verdict gives to others.
#pragma once

#include <fmt/format.h>

#include <cmath>

namespace trunnion::inline base {

/// Is made from any double and used as one; a comparison of two never fails open.
class Finite {
  public:
    constexpr Finite() = default;
    /// Throws InputError when `value` is NaN or infinite.
    Finite(double value) : value_(value) {  // NOLINT: a result becomes one at its door
        if (!std::isfinite(value)) refuse();
    }

    constexpr operator double() const { return value_; }  // NOLINT: it is a number
    constexpr double value() const { return value_; }

  private:
    [[noreturn]] static void refuse();

    double value_ = 0.0;
};

/// The number alone (found by nlohmann::json).
template <typename Json>
void to_json(Json& json, const Finite& number) {
    json = number.value();
}

}  // namespace trunnion::inline base

template <>
struct fmt::formatter<trunnion::Finite> : fmt::formatter<double> {
    template <typename Context>
    auto format(const trunnion::Finite& number, Context& context) const {
        return fmt::formatter<double>::format(number.value(), context);
    }
};
