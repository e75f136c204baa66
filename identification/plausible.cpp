#include "identification/plausible.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/alarm.h"
#include "base/rounded.h"
#include "base/units.h"

namespace trunnion::identification {
namespace {

constexpr double absurd_mm = 5.0;  ///< limit of a plausible residual; beyond it units, frame or
                                   ///< setup are wrong
constexpr double absurd_rms_mm = 0.5;
/// An arm whose joints were never calibrated misses by millimetres; a wrong unit or frame by far
/// more.
constexpr double of_an_arm = 10.0;
constexpr double absurd_rad = 0.03;  ///< of a location error
constexpr double absurd_zero_rad = 0.5;
/// Delay of the slowest position loop: its following error at speed is large, and plausible
/// (assumed).
constexpr double longest_lag_s = 0.25;

/// Implausible results are refused, or noted when the user declared them as intended.
void tell_absurd(BaseModel& model, bool meant, const std::string& what, const SourceRef& where) {
    const std::string message = what +
                                " after fitting: wrong units (um for mm?), wrong frame, or "
                                "the setup of another machine";
    if (!meant) throw InputError(message + "; --allow-large accepts it", where);
    model.notes.push_back(where.program + ": " + message + "; accepted");
}

/// The largest speed of an axis until now, less what even the slowest loop has caught up since: an
/// axis that stops after a fast move lags on.
class RecentSpeed {
  public:
    double after(Axis axis, const AxisSample& sample) {
        Last& last = last_[index_of(axis)];
        const double since_s = std::max(0.0, sample.time_s - last.time_s);
        last.speed = std::max(std::abs(sample.velocity[axis]),
                              last.speed * std::exp(-since_s / longest_lag_s));
        last.time_s = sample.time_s;
        return last.speed;
    }

  private:
    struct Last {
        double speed = 0.0, time_s = 0.0;
    };
    std::array<Last, axis_count> last_{};
};

/// Sizes of the residuals; those of a servo log as far as no lag of the axis explains them, beside
/// the fitted zero of its encoder or none, because a lag at mostly one speed looks like a zero.
Eigen::VectorXd without_lag(const BaseModel& model, const emulator::Replay& replay) {
    Eigen::VectorXd size = model.residual_mm.cwiseAbs();
    RecentSpeed speed;
    for (Eigen::Index i = 0; i < size.size(); ++i) {
        const auto row = static_cast<std::size_t>(i);
        const emulator::Contact& contact = replay.contact(row);
        if (contact.device != records::Device::axis) continue;
        const double lag_mm = longest_lag_s * speed.after(contact.axis, replay.sample(row));
        const std::size_t k = index_of(contact.axis);
        const double zero = model.setup.encoder_zero[k] - replay.setup().encoder_zero[k];
        const double least = std::min(size(i), std::abs(model.residual_mm(i) + zero));
        size(i) = std::max(0.0, least - lag_mm);
    }
    return size;
}

/// How much wider the limits are.
double width_of(const setup::Setup& setup) {
    return setup::is_arm(setup.machine.chain) ? of_an_arm : 1.0;
}

}  // namespace

double absurd_residual_mm(const setup::Setup& setup) {
    return width_of(setup) * absurd_mm;
}

void tell_absurd_residuals(BaseModel& model, const emulator::Replay& replay,
                           const records::ReadingTable& table) {
    const bool allowed = model.setup.model.allow_large;
    const Eigen::VectorXd size = without_lag(model, replay);
    Eigen::Index worst = 0;
    const double most = size.maxCoeff(&worst);
    const records::Reading& row = table.rows[replay.table_row(static_cast<std::size_t>(worst))];
    const bool meant = allowed || row.sigma_mm.value_or(0.0) > 0.0;
    if (most > absurd_residual_mm(model.setup))
        tell_absurd(model, meant, fmt::format("a residual of {} mm", three_digits(most)),
                    records::place_of(table, row));
    const double rms = std::sqrt(size.squaredNorm() / static_cast<double>(size.size()));
    if (rms > width_of(model.setup) * absurd_rms_mm)
        tell_absurd(model, meant, fmt::format("residuals of {} mm rms", three_digits(rms)),
                    {table.path, 0, 0});
}

namespace {

/// A zero of an encoder may be large, where a log has machine positions beside those of a program,
/// but it is more often a wrong column or unit.
void tell_absurd_zero(BaseModel& model, const FitParameter& p, const records::ReadingTable& table) {
    const bool angle = p.unit == "rad";
    if (p.set_up.kind != SetUpQuantity::Kind::encoder ||
        std::abs(p.value) <= (angle ? absurd_zero_rad : absurd_mm))
        return;
    tell_absurd(model, model.setup.model.allow_large,
                fmt::format("{} beside the commanded position in all rows: {} {}",
                            p.name.substr(0, p.name.find('.')),
                            three_digits(angle ? deg_from_rad(p.value) : p.value.value()),
                            angle ? "deg" : "mm"),
                {table.path, 0, 0});
}

/// What the readings leave to a value, by their own scatter: one that they hardly see (a target
/// almost on its axis) may come out as anything.
double least_size(const BaseModel& model, const FitParameter& p) {
    constexpr double sigmas = 3.0;
    const Eigen::VectorXd relative = model.residual_mm.cwiseQuotient(model.sigma_mm);
    const double misfit =
        std::max(1.0, std::sqrt(relative.squaredNorm() / static_cast<double>(relative.size())));
    return std::abs(p.value) - sigmas * misfit * p.sigma;
}

}  // namespace

/// An implausible location error means that the setup describes another machine.
void tell_absurd_value(BaseModel& model, const FitParameter& p,
                       const records::ReadingTable& table) {
    tell_absurd_zero(model, p, table);
    if (p.location && std::isfinite(p.sigma) &&
        least_size(model, p) > width_of(model.setup) * (p.unit == "mm" ? absurd_mm : absurd_rad))
        tell_absurd(model, model.setup.model.allow_large,
                    fmt::format("{} comes out as {} {}", p.name, three_digits(p.value), p.unit),
                    {table.path, 0, 0});
}

}  // namespace trunnion::identification
