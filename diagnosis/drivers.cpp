#include "diagnosis/drivers.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "base/units.h"
#include "diagnosis/rules.h"
#include "diagnosis/statistics.h"

namespace trunnion {
namespace {

/// A driver: functions of each row; each is multiplied by every carrier (a way in which a reading
/// can move: machine directions, table directions, an axis).
struct Driver {
    std::string by, component, text;
    std::vector<std::vector<double>> columns;  ///< by column, one entry a row
};

using RowFunction = std::function<double(std::size_t)>;

std::vector<double> tabulate(std::size_t n, const RowFunction& f) {
    std::vector<double> v(n);
    for (std::size_t i = 0; i < n; ++i) v[i] = f(i);
    return v;
}

class DriverList {
  public:
    DriverList(const Replay& replay, const ReadingTable& table, const BaseModel& base)
        : replay_(replay), table_(table), base_(base) {
        positions();
        directions();
        clocks();
        states();
        instrument();
    }
    const std::vector<Driver>& all() const { return drivers_; }

  private:
    std::size_t n() const { return replay_.size(); }
    bool turns(Axis axis) const { return table_.names.is_rotary(axis); }

    RowFunction machine(int d) const {
        return [this, d](std::size_t i) { return replay_.contact(i).direction_M(d); };
    }
    RowFunction table(int d) const {
        return [this, d](std::size_t i) { return replay_.contact(i).direction_W(d); };
    }
    RowFunction axis_response(Axis axis) const {
        return [this, axis](std::size_t i) {
            return base_.gradient[i].axis[axis] * (turns(axis) ? 0.01 : 1.0);
        };
    }
    RowFunction tilt_response(Axis axis, int d) const {
        return [this, axis, d](std::size_t i) {
            return base_.gradient[i].motion[index_of(axis)].tilt_rad(d) * 0.01;
        };
    }

    /// Adds columns f * carrier for all pairs.
    void add(std::string by, std::string component, std::string text,
             const std::vector<RowFunction>& functions, const std::vector<RowFunction>& carriers) {
        Driver driver{std::move(by), std::move(component), std::move(text), {}};
        for (const RowFunction& f : functions)
            for (const RowFunction& c : carriers)
                driver.columns.push_back(tabulate(n(), [&](std::size_t i) { return f(i) * c(i); }));
        drivers_.push_back(std::move(driver));
    }

    std::vector<RowFunction> machine_axes() const { return {machine(0), machine(1), machine(2)}; }
    std::vector<RowFunction> table_axes() const { return {table(0), table(1), table(2)}; }

    /// Smooth functions of a position: polynomials of the range, or harmonics of a whole turn, and
    /// a step at zero.
    std::vector<RowFunction> smooth(const RowFunction& q, double low, double high, bool turn,
                                    int order) const {
        std::vector<RowFunction> list;
        for (int k = 1; k <= order; ++k) {
            if (turn) {
                list.push_back([=](std::size_t i) { return std::cos(k * q(i)); });
                list.push_back([=](std::size_t i) { return std::sin(k * q(i)); });
            } else {
                const double mid = 0.5 * (low + high), half = std::max(1e-9, 0.5 * (high - low));
                list.push_back([=](std::size_t i) {
                    const double u = std::clamp((q(i) - mid) / half, -1.0, 1.0);
                    return std::cos(k * std::acos(u));
                });
            }
        }
        return list;
    }

    void positions() {
        for (const Axis axis : table_.axes) {
            const RowFunction q = [this, axis](std::size_t i) {
                return replay_.sample(i).position[axis];
            };
            double low = 1e300, high = -1e300;
            for (std::size_t i = 0; i < n(); ++i) {
                low = std::min(low, q(i));
                high = std::max(high, q(i));
            }
            if (high - low < (turns(axis) ? 0.05 : 1.0)) continue;
            const bool turn = turns(axis) && high - low > 5.0;
            auto functions = smooth(q, low, high, turn, turn ? 6 : 7);
            if (low < 0.0 && high > 0.0 && !turn)
                functions.push_back([q](std::size_t i) { return q(i) > 0.0 ? 1.0 : -1.0; });
            std::vector<RowFunction> carriers{machine(0), machine(1), machine(2)};
            carriers.push_back(axis_response(axis));
            const std::string& name = table_.names[axis];
            add(name, "machine frame", "follows the position of " + name, functions, carriers);
            if (!turns(axis)) continue;
            add(name, "angles", "follows the position of " + name + " as a tilt", functions,
                {tilt_response(axis, 0), tilt_response(axis, 1), tilt_response(axis, 2)});
        }
    }

    void directions() {
        for (const Axis axis : table_.axes) {
            const RowFunction sign = [this, axis](std::size_t i) {
                return static_cast<double>(replay_.sample(i).travel[index_of(axis)]);
            };
            const RowFunction q = [this, axis](std::size_t i) {
                return replay_.sample(i).position[axis] * (turns(axis) ? 0.5 : 0.01);
            };
            std::set<double> values;
            for (std::size_t i = 0; i < n(); ++i) values.insert(sign(i));
            if (!values.count(-1.0) || !values.count(1.0)) continue;
            const std::string& name = table_.names[axis];
            const RowFunction since = [this, axis, sign](std::size_t i) {
                const double s = replay_.sample(i).since_reversal[index_of(axis)];
                return sign(i) * std::exp(-s / (turns(axis) ? 0.1 : 3.0));
            };
            add("direction of " + name, "machine frame",
                "changes sign with the direction of " + name,
                {sign, [=](std::size_t i) { return sign(i) * q(i); },
                 [=](std::size_t i) { return sign(i) * q(i) * q(i); }, since},
                {machine(0), machine(1), machine(2), axis_response(axis)});
        }
    }

    void clocks() {
        double start = 1e300, end = -1e300, cold = 1e300, warm = -1e300;
        for (std::size_t i = 0; i < n(); ++i) {
            start = std::min(start, replay_.sample(i).time_s);
            end = std::max(end, replay_.sample(i).time_s);
            cold = std::min(cold, replay_.sample(i).temperature_c);
            warm = std::max(warm, replay_.sample(i).temperature_c);
        }
        const RowFunction t = [this](std::size_t i) { return replay_.sample(i).time_s; };
        if (end - start > 60.0) {
            auto functions = smooth(t, start, end, false, 6);
            add("time", "machine frame", "drifts with time", functions, machine_axes());
            add("time", "table frame", "moves with the table at some moment", functions,
                table_axes());
        }
        if (warm - cold < 0.3) return;
        const RowFunction warmth = [this](std::size_t i) {
            return replay_.sample(i).temperature_c - 20.0;
        };
        std::vector<RowFunction> carriers = machine_axes();
        for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
            carriers.push_back([this, axis](std::size_t i) {
                return base_.gradient[i].axis[axis] * replay_.sample(i).position[axis] * 0.01;
            });
        add("temperature", "machine frame", "grows with temperature", {warmth}, carriers);
    }

    void states() {
        std::set<PositioningMode> modes;
        std::set<std::string> tests;
        bool load = false, clamp = false, spindle = false;
        for (std::size_t i = 0; i < n(); ++i) {
            modes.insert(replay_.sample(i).mode);
            tests.insert(table_.rows[replay_.table_row(i)].test);
            load = load || replay_.sample(i).load_kg != replay_.sample(0).load_kg;
            clamp = clamp || replay_.sample(i).clamped != replay_.sample(0).clamped;
            spindle = spindle || replay_.sample(i).spindle_rad != replay_.sample(0).spindle_rad;
        }
        std::vector<RowFunction> both = machine_axes();
        for (const RowFunction& f : table_axes()) both.push_back(f);
        if (modes.size() > 1) {
            std::vector<RowFunction> each;
            for (auto it = std::next(modes.begin()); it != modes.end(); ++it)
                each.push_back([this, m = *it](std::size_t i) {
                    return replay_.sample(i).mode == m ? 1.0 : 0.0;
                });
            add("mode", "machine and table frame", "depends on the positioning function", each,
                both);
        }
        if (load)
            add("load", "machine and table frame", "depends on the load",
                {[this](std::size_t i) { return replay_.sample(i).load_kg * 0.01; }}, both);
        if (clamp)
            add("clamp", "machine and table frame", "depends on the clamp",
                {[this](std::size_t i) { return replay_.sample(i).clamped ? 1.0 : 0.0; }}, both);
        if (spindle)
            add("spindle", "machine frame", "turns with the spindle",
                {[this](std::size_t i) { return std::cos(replay_.sample(i).spindle_rad); },
                 [this](std::size_t i) { return std::sin(replay_.sample(i).spindle_rad); }},
                machine_axes());
        if (tests.size() > 1 && tests.size() <= 60) {
            std::vector<RowFunction> each;
            for (auto it = std::next(tests.begin()); it != tests.end(); ++it)
                each.push_back([this, name = *it](std::size_t i) {
                    return table_.rows[replay_.table_row(i)].test == name ? 1.0 : 0.0;
                });
            add("test", "reading", "is an offset of single tests", each,
                {[](std::size_t) { return 1.0; }});
        }
    }

    void instrument() {
        bool touch = false, bar = false;
        for (std::size_t i = 0; i < n(); ++i) {
            touch = touch || replay_.contact(i).device == Device::touch;
            bar = bar || replay_.contact(i).device == Device::ballbar;
        }
        if (touch) {
            const auto azimuth = [this](std::size_t i) {
                const Vector3& d = replay_.contact(i).direction_M;
                return std::atan2(d.y(), d.x()) - replay_.sample(i).spindle_rad;
            };
            const RowFunction across = [this](std::size_t i) {
                const Vector3& d = replay_.contact(i).direction_M;
                return replay_.contact(i).device == Device::touch ? std::hypot(d.x(), d.y()) : 0.0;
            };
            add("probe direction", "along the approach", "depends on the direction of the touch",
                smooth(azimuth, 0, 0, true, 4), {across});
        }
        if (!bar) return;
        std::vector<RowFunction> speed;
        for (const Axis axis : table_.axes)
            speed.push_back([this, axis](std::size_t i) {
                return base_.gradient[i].axis[axis] * replay_.sample(i).velocity[axis] * 0.01;
            });
        for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
            speed.push_back([this, axis](std::size_t i) {
                return base_.gradient[i].axis[axis] * replay_.sample(i).acceleration[axis] * 0.01;
            });
        add("velocity", "along the path", "grows with the feed", {[](std::size_t) { return 1.0; }},
            speed);
    }

    const Replay& replay_;
    const ReadingTable& table_;
    const BaseModel& base_;
    std::vector<Driver> drivers_;
};

}  // namespace

namespace {

/// Fall of a squared sum when `extra` columns join the `known` ones.
class Gain {
  public:
    Gain(Eigen::MatrixXd known, const Eigen::VectorXd& data) : known_(std::move(known)) {
        for (Eigen::Index j = 0; j < known_.cols(); ++j)
            known_.col(j) /= std::max(1e-12, known_.col(j).norm());
        Eigen::MatrixXd square = known_.transpose() * known_;
        square.diagonal().array() += 1e-9;
        llt_.compute(square);
        left_ = data - known_ * llt_.solve(known_.transpose() * data);
        sum_ = left_.squaredNorm();
    }

    double of(Eigen::MatrixXd extra) const {
        for (Eigen::Index j = 0; j < extra.cols(); ++j)
            extra.col(j) /= std::max(1e-12, extra.col(j).norm());
        const Eigen::MatrixXd cross = known_.transpose() * extra;
        Eigen::MatrixXd square = extra.transpose() * extra - cross.transpose() * llt_.solve(cross);
        square.diagonal().array() += 1e-6;
        const Eigen::VectorXd h = extra.transpose() * left_;
        return std::clamp(h.dot(square.ldlt().solve(h)), 0.0, sum_);
    }
    double sum() const { return sum_; }

  private:
    Eigen::MatrixXd known_;
    Eigen::LLT<Eigen::MatrixXd> llt_;
    Eigen::VectorXd left_;
    double sum_ = 0.0;
};

}  // namespace

std::vector<DriverTest> test_drivers(const Replay& replay, const ReadingTable& table,
                                     const BaseModel& base, const Eigen::MatrixXd& known,
                                     const Eigen::VectorXd& left_mm,
                                     const Eigen::VectorXd& sigma_mm, const std::vector<bool>& used,
                                     const Whitener& whitener) {
    Eigen::VectorXd weight = sigma_mm.cwiseInverse();
    double rows = 0.0;
    for (Eigen::Index i = 0; i < weight.size(); ++i)
        used[static_cast<std::size_t>(i)] ? rows += 1.0 : weight(i) = 0.0;
    const Gain plain(weight.asDiagonal() * known, weight.cwiseProduct(left_mm));
    Eigen::MatrixXd white_known = known;
    whitener.apply(white_known);
    const Gain white(std::move(white_known), whitener.apply(left_mm));
    const double freedom = rows - static_cast<double>(known.cols());
    const DriverList list(replay, table, base);
    std::vector<DriverTest> tests;
    for (const Driver& driver : list.all()) {
        Eigen::MatrixXd columns(left_mm.size(), static_cast<Eigen::Index>(driver.columns.size()));
        for (std::size_t c = 0; c < driver.columns.size(); ++c)
            columns.col(static_cast<Eigen::Index>(c)) =
                Eigen::Map<const Eigen::VectorXd>(driver.columns[c].data(), left_mm.size());
        const double q = static_cast<double>(columns.cols());
        if (freedom - q < 5.0) continue;
        const double rest = std::max(1e-12, plain.sum() - plain.of(weight.asDiagonal() * columns));
        whitener.apply(columns);
        const double gain = white.of(columns);
        const double white_rest = std::max(1e-12, white.sum() - gain) / (freedom - q);
        DriverTest test{driver.by,   driver.component,
                        driver.text, 0.0,
                        1.0,         static_cast<int>(driver.columns.size()),
                        gain};
        test.explained = plain.sum() / freedom - rest / (freedom - q);
        test.p_value = std::min(1.0, f_tail(gain / q / white_rest, q, freedom - q) *
                                         static_cast<double>(list.all().size()));
        tests.push_back(test);
    }
    std::stable_sort(tests.begin(), tests.end(), [](const DriverTest& x, const DriverTest& y) {
        return x.explained > y.explained;
    });
    return tests;
}

Eigen::VectorXd without_drivers(const Replay& replay, const ReadingTable& table,
                                const BaseModel& base, const Eigen::MatrixXd& known,
                                const Eigen::VectorXd& left_mm, const Eigen::VectorXd& sigma_mm,
                                const std::vector<bool>& used, const Whitener& whitener,
                                double& lost) {
    lost = 0.0;
    const DriverList list(replay, table, base);
    std::vector<const Driver*> chosen;
    for (const DriverTest& t :
         test_drivers(replay, table, base, known, left_mm, sigma_mm, used, whitener)) {
        if (t.p_value > rules::driver_p ||
            lost + t.columns > static_cast<double>(left_mm.size()) / 3)
            continue;
        for (const Driver& d : list.all())
            if (d.by == t.by && d.component == t.component) chosen.push_back(&d);
        lost += t.columns;
    }
    const auto p = known.cols();
    Eigen::MatrixXd a(left_mm.size(), p + static_cast<Eigen::Index>(lost));
    a.leftCols(p) = known;
    Eigen::Index at = p;
    for (const Driver* d : chosen)
        for (const auto& column : d->columns)
            a.col(at++) = Eigen::Map<const Eigen::VectorXd>(column.data(), left_mm.size());
    Eigen::VectorXd weight = sigma_mm.cwiseInverse();
    for (Eigen::Index i = 0; i < weight.size(); ++i)
        if (!used[static_cast<std::size_t>(i)]) weight(i) = 0.0;
    a = weight.asDiagonal() * a;
    for (Eigen::Index j = 0; j < a.cols(); ++j) a.col(j) /= std::max(1e-12, a.col(j).norm());
    Eigen::MatrixXd square = a.transpose() * a;
    square.diagonal().array() += 1e-7;
    const Eigen::VectorXd z = weight.cwiseProduct(left_mm);
    const Eigen::VectorXd rest = z - a * square.llt().solve(a.transpose() * z);
    return sigma_mm.cwiseProduct(rest);
}

}  // namespace trunnion
