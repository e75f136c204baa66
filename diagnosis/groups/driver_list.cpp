#include "diagnosis/groups/driver_list.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "diagnosis/groups/driver_functions.h"
#include "diagnosis/prepare/cycles.h"
#include "effects/catalogue.h"

namespace trunnion::diagnosis {
namespace {

class DriverList {
  public:
    DriverList(const emulator::Replay& replay, const records::ReadingTable& table,
               const identification::BaseModel& base, std::vector<Axis> with_play)
        : replay_(replay), table_(table), base_(base), with_play_(std::move(with_play)) {
        positions();
        encoders();
        products();
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
        drivers_.push_back({std::move(by), std::move(component), std::move(text), {}, {}});
        extend(functions, carriers);
    }

    /// A course of time, and a random walk, which stands against causes (contender_search.cpp).
    void add_course(std::string component, std::string text,
                    const std::vector<RowFunction>& carriers, double start, double end) {
        const RowFunction t = [this](std::size_t i) { return replay_.sample(i).time_s; };
        add("time", std::move(component), std::move(text),
            without_mean(smooth_functions(t, {start, end}, 6), n()), carriers);
        drivers_.back().of_time = true;
        for (const RowFunction& f : without_mean(random_walk(t, {start, end}), n()))
            for (const RowFunction& c : carriers)
                drivers_.back().walk.push_back(
                    tabulate(n(), [&](std::size_t i) { return f(i) * c(i); }));
    }

    /// More columns of the driver added last.
    void extend(const std::vector<RowFunction>& functions,
                const std::vector<RowFunction>& carriers) {
        for (const RowFunction& f : functions)
            for (const RowFunction& c : carriers)
                drivers_.back().columns.push_back(
                    tabulate(n(), [&](std::size_t i) { return f(i) * c(i); }));
    }

    bool has_table_of_play(Axis axis) const {
        return std::find(with_play_.begin(), with_play_.end(), axis) != with_play_.end();
    }

    /// Carriers of what depends on the side alone. The angle of an axis whose play has a table is a
    /// cause with a name, and no driver: whole, it would take the place of backlash and table.
    std::vector<RowFunction> beside_backlash(Axis axis) const {
        std::vector<RowFunction> carriers = machine_axes();
        carriers.push_back(axis_response(axis));
        if (!turns(axis) || !has_table_of_play(axis)) return carriers;
        for (RowFunction& carrier : carriers)
            carrier = [this, axis, carrier](std::size_t i) {
                const bool is_its_angle = replay_.contact(i).device == records::Device::angle &&
                                          base_.gradient[i].axis[axis] != 0.0;
                return is_its_angle ? 0.0 : carrier(i);
            };
        return carriers;
    }

    /// Carriers of what depends on side and place. Along an axis whose play has a table that is a
    /// cause with a name, and no driver.
    std::vector<RowFunction> beside_play(Axis axis) const {
        std::vector<RowFunction> carriers = beside_backlash(axis);
        if (!has_table_of_play(axis)) return carriers;
        carriers.pop_back();
        if (!turns(axis))
            carriers.erase(carriers.begin() +
                           effects::main_direction(*base_.setup.machine.chain.find(axis)));
        return carriers;
    }

    std::vector<RowFunction> machine_axes() const { return {machine(0), machine(1), machine(2)}; }
    std::vector<RowFunction> table_axes() const { return {table(0), table(1), table(2)}; }

    /// The positions of an axis that moves; empty where its readings cannot show a dependence.
    struct Travel {
        Axis axis = Axis::X;
        RowFunction q;
        double low = 1e300, high = -1e300, mean = 0.0;  ///< mm or rad
        bool turn = false;                              ///< a whole turn of a rotary axis
    };
    std::optional<Travel> travel(Axis axis) const {
        Travel t{axis, [this, axis](std::size_t i) { return replay_.sample(i).position[axis]; }};
        for (std::size_t i = 0; i < n(); ++i) {
            t.low = std::min(t.low, t.q(i));
            t.high = std::max(t.high, t.q(i));
            t.mean += t.q(i) / static_cast<double>(n());
        }
        if (!(t.high - t.low >= (turns(axis) ? 0.05 : 1.0))) return std::nullopt;
        t.turn = turns(axis) && t.high - t.low > 5.0;
        return t;
    }

    /// Products of two positions, and of their bows: an error over a plane that no motion of single
    /// axes makes (a slope along one axis that depends on the other is an angular error motion).
    void products() {
        std::vector<Travel> moving;
        for (const Axis axis : table_.axes)
            if (const auto t = travel(axis); t && !t->turn) moving.push_back(*t);
        const auto reduced = [](const Travel& t) {
            const double half = 0.5 * (t.high - t.low);
            return [t, half](std::size_t i) { return (t.q(i) - t.mean) / half; };
        };
        for (std::size_t a = 0; a < moving.size(); ++a)
            for (std::size_t b = a + 1; b < moving.size(); ++b) {
                const std::string names =
                    table_.names[moving[a].axis] + " and " + table_.names[moving[b].axis];
                const RowFunction u = reduced(moving[a]), v = reduced(moving[b]);
                Driver driver{names,
                              "machine frame",
                              "follows the product of the positions of " + names,
                              {},
                              {}};
                for (const RowFunction& carrier : machine_axes())
                    for (auto& column : products_of(u, v, carrier))
                        driver.columns.push_back(std::move(column));
                if (!driver.columns.empty()) drivers_.push_back(std::move(driver));
            }
    }

    /// Products of two positions and of their bows, times a carrier: those that are no function of
    /// one position each. Along a line where one axis rests, a product is an error of the other.
    std::vector<std::vector<double>> products_of(const RowFunction& u, const RowFunction& v,
                                                 const RowFunction& carrier) const {
        constexpr double least = 0.1;  // of a product that the sum of such functions leaves
        Eigen::MatrixXd each(static_cast<Eigen::Index>(n()), 5), product(each.rows(), 2);
        for (std::size_t i = 0; i < n(); ++i) {
            const auto row = static_cast<Eigen::Index>(i);
            const double c = carrier(i);
            each.row(row) << c, c * u(i), c * bow(u(i)), c * v(i), c * bow(v(i));
            product.row(row) << c * u(i) * v(i), c * bow(u(i)) * bow(v(i));
        }
        const Eigen::MatrixXd left = product - each * each.colPivHouseholderQr().solve(product);
        std::vector<std::vector<double>> columns;
        for (Eigen::Index k = 0; k < left.cols(); ++k)
            if (left.col(k).norm() > least * product.col(k).norm())
                columns.emplace_back(product.col(k).begin(), product.col(k).end());
        return columns;
    }

    void positions() {
        for (const Axis axis : table_.axes) {
            const auto moving = travel(axis);
            if (!moving) continue;
            const RowFunction& q = moving->q;
            const bool turn = moving->turn;
            auto functions =
                turn ? harmonics(q, 6) : smooth_functions(q, {moving->low, moving->high}, 7);
            if (moving->low < 0.0 && moving->high > 0.0 && !turn)
                functions.push_back([q](std::size_t i) { return q(i) > 0.0 ? 1.0 : -1.0; });
            std::vector<RowFunction> carriers{machine(0), machine(1), machine(2)};
            carriers.push_back(axis_response(axis));
            const std::string& name = table_.names[axis];
            add(name, "machine frame", "follows the position of " + name, functions, carriers);
            // What follows one axis is an error motion of it, as a table.
            drivers_.back().only_where = true;
            if (!turns(axis)) continue;
            add(name, "angles", "follows the position of " + name + " as a tilt", functions,
                {tilt_response(axis, 0), tilt_response(axis, 1), tilt_response(axis, 2)});
            drivers_.back().only_where = true;
        }
    }

    /// What an encoder reads beside the command does not follow the position of its axis by any
    /// cause but a gain.
    void encoders() {
        for (const Axis axis : table_.axes) {
            const auto moving = travel(axis);
            const RowFunction carrier = [this, axis](std::size_t i) {
                const emulator::Contact& contact = replay_.contact(i);
                return contact.device == records::Device::axis && contact.axis == axis ? 1.0 : 0.0;
            };
            const std::vector<double> logged = tabulate(n(), carrier);
            if (!moving || std::count(logged.begin(), logged.end(), 1.0) == 0) continue;
            const std::string& name = table_.names[axis];
            add(name, "its encoder", "follows the position of " + name,
                smooth_functions(moving->q, {moving->low, moving->high}, 7), {carrier});
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
            constexpr int few = 3;  // a first row of unknown side is no second direction
            int forward = 0, back = 0;
            for (std::size_t i = 0; i < n(); ++i) {
                if (sign(i) > 0.0) ++forward;
                if (sign(i) < 0.0) ++back;
            }
            if (std::min(forward, back) < few) continue;
            const std::string& name = table_.names[axis];
            const RowFunction since = [this, axis, sign](std::size_t i) {
                const double s = replay_.sample(i).since_reversal[index_of(axis)];
                return sign(i) * std::exp(-s / (turns(axis) ? 0.1 : 3.0));
            };
            add("direction of " + name, "machine frame",
                "changes sign with the direction of " + name, {sign, since}, beside_backlash(axis));
            drivers_.back().has_effect = true;
            extend({[=](std::size_t i) { return sign(i) * q(i); },
                    [=](std::size_t i) { return sign(i) * q(i) * q(i); }},
                   beside_play(axis));
        }
    }

    bool is_ordered_by_axes() const {
        return is_one_sweep(replay_, table_.axes) || is_one_cycle(replay_, table_.axes);
    }

    void clocks() {
        double start = 1e300, end = -1e300, cold = 1e300, warm = -1e300;
        for (std::size_t i = 0; i < n(); ++i) {
            start = std::min(start, replay_.sample(i).time_s);
            end = std::max(end, replay_.sample(i).time_s);
            cold = std::min(cold, replay_.sample(i).temperature_c);
            warm = std::max(warm, replay_.sample(i).temperature_c);
        }
        // Without a clock, in one sweep, the order of the readings is the position of the axis; in
        // one cycle, position and side.
        const bool told = records::has_times(table_);
        if (end - start > 60.0 && (told || !is_ordered_by_axes())) {
            add_course("machine frame",
                       told ? "drifts with time" : "changes in the order of the readings",
                       machine_axes(), start, end);
            add_course("table frame",
                       told ? "moves with the table at some moment"
                            : "moves with the table at some reading",
                       table_axes(), start, end);
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
        bool load = false, clamp = false, spindle = false;
        for (std::size_t i = 0; i < n(); ++i) {
            modes.insert(replay_.sample(i).mode);
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
    }

    void instrument() {
        bool touch = false, bar = false;
        for (std::size_t i = 0; i < n(); ++i) {
            touch = touch || replay_.contact(i).device == records::Device::touch;
            bar = bar || replay_.contact(i).device == records::Device::ballbar;
        }
        if (touch) {
            const auto azimuth = [this](std::size_t i) {
                const Vector3& d = replay_.contact(i).direction_M;
                return std::atan2(d.y(), d.x()) - replay_.sample(i).spindle_rad;
            };
            const RowFunction across = [this](std::size_t i) {
                const Vector3& d = replay_.contact(i).direction_M;
                return replay_.contact(i).device == records::Device::touch
                           ? std::hypot(d.x(), d.y())
                           : 0.0;
            };
            add("probe direction", "along the approach", "depends on the direction of the touch",
                harmonics(azimuth, 4), {across});
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

    const emulator::Replay& replay_;
    const records::ReadingTable& table_;
    const identification::BaseModel& base_;
    std::vector<Axis> with_play_;  ///< axes whose play has a table
    std::vector<Driver> drivers_;
};

}  // namespace

std::vector<Driver> drivers_of(const emulator::Replay& replay, const records::ReadingTable& table,
                               const identification::BaseModel& base, std::vector<Axis> with_play) {
    return DriverList(replay, table, base, std::move(with_play)).all();
}

}  // namespace trunnion::diagnosis
