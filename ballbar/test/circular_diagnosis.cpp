// Error traces of two linear axes on a circle, and the amount of each.
#include "ballbar/test/circular_diagnosis.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

#include "base/units.h"

namespace trunnion::ballbar::test {
namespace {

constexpr double full_weight_gain = 30.0;  ///< minimum gain of a trace with key, times the noise
                                           ///< variance

/// A point of the circle: bar from the pivot outwards, axes u and v of the plane.
struct CirclePoint {
    double cos, sin;    ///< of the bar's angle
    double u_mm, v_mm;  ///< commanded, relative to the circle's centre
    double machine_u_mm, machine_v_mm;
    double velocity_u, velocity_v;        ///< mm/s
    double travel_u, travel_v;            ///< -1 or 1
    double reversal_u_mm, reversal_v_mm;  ///< distance since the axis reversed
    double radial_mm;
};

/// Change of the bar's length for a unit of the error: its displacement of the tool along the bar.
using Shape = std::function<double(const CirclePoint&)>;

struct Term {
    CircularCause cause;
    Shape shape;
    bool nuisance = false;
};

bool turns_within(const CircularPass& pass, std::size_t begin, std::size_t end, Axis axis) {
    const std::size_t i = index_of(axis);
    return pass.samples[begin].travel[i] != pass.samples[end - 1].travel[i];
}

/// Means of neighbouring readings; rows at a reversal point contain no information about reversal.
std::vector<CirclePoint> points_of(const CircularTest& test) {
    const auto [u, v] = axes_of_plane(test.plane);
    std::vector<CirclePoint> points;
    for (const CircularPass& pass : test.passes) {
        // The set-up eccentricity, whose square would look like an ellipse, is removed.
        const auto radial_mm = centred_radial_mm(pass, test.circle, test.radius_mm);
        const std::size_t count = pass.angle_rad.size(), blocks = std::min(count, points_per_pass);
        for (std::size_t b = 0; b < blocks; ++b) {
            const std::size_t begin = count * b / blocks, end = count * (b + 1) / blocks;
            const std::size_t middle = (begin + end - 1) / 2;
            const AxisSample& s = pass.samples[middle];
            if (s.travel[index_of(u)] == 0 || s.travel[index_of(v)] == 0 ||
                turns_within(pass, begin, end, u) || turns_within(pass, begin, end, v))
                continue;
            double sum = 0.0;
            for (std::size_t i = begin; i < end; ++i) sum += radial_mm[i];
            const double a = pass.angle_rad[middle];
            points.push_back(
                {std::cos(a), std::sin(a), s.position[u] - test.center_M_mm.x(),
                 s.position[v] - test.center_M_mm.y(), s.position[u], s.position[v], s.velocity[u],
                 s.velocity[v], static_cast<double>(s.travel[index_of(u)]),
                 static_cast<double>(s.travel[index_of(v)]), s.since_reversal[index_of(u)],
                 s.since_reversal[index_of(v)], sum / static_cast<double>(end - begin)});
        }
    }
    return points;
}

Term nuisance(Shape shape) {
    return {{}, std::move(shape), true};
}

Term term(const std::string& name, const std::string& effect, const std::string& unit,
          Shape shape) {
    Term out;
    out.cause.name = name;
    out.cause.effect = effect;
    out.cause.unit = unit;
    out.shape = std::move(shape);
    return out;
}

/// Values in um, um/m, ms: trace of one such unit in mm.
std::vector<Term> plain_terms(const CircularTest& test) {
    const auto [axis_u, axis_v] = axes_of_plane(test.plane);
    const std::string u(1, letter_of(axis_u)), v(1, letter_of(axis_v)), uv = plane_name(test.plane);
    const double radius = test.radius_mm;
    using P = const CirclePoint&;
    return {nuisance([](P) { return 1.0; }), nuisance([](P p) { return p.cos; }),
            nuisance([](P p) { return p.sin; }),
            // E_C0Y and similar: rotation of the second axis about the plane's normal.
            term("squareness " + uv, uv + ".squareness", "um/m",
                 [](P p) { return -1e-6 * p.v_mm * p.cos; }),
            term("scale mismatch " + u + "-" + v, u + ".scale", "um/m",
                 [](P p) { return 0.5e-6 * (p.u_mm * p.cos - p.v_mm * p.sin); }),
            term("servo mismatch " + u + "-" + v, "servo.mismatch", "ms",
                 [](P p) { return -0.5e-3 * (p.velocity_u * p.cos - p.velocity_v * p.sin); }),
            term("backlash " + u, u + ".backlash", "um",
                 [](P p) { return 0.5e-3 * p.travel_u * p.cos; }),
            term("backlash " + v, v + ".backlash", "um",
                 [](P p) { return 0.5e-3 * p.travel_v * p.sin; }),
            term("lateral play " + u, u + ".lateral_play", "um",
                 [](P p) { return 0.5e-3 * p.travel_u * p.sin; }),
            term("lateral play " + v, v + ".lateral_play", "um",
                 [](P p) { return 0.5e-3 * p.travel_v * p.cos; }),
            term("straightness " + u, u + ".straightness", "um",
                 [radius](P p) { return 1e-3 * p.u_mm * p.u_mm / (radius * radius) * p.sin; }),
            term("straightness " + v, v + ".straightness", "um",
                 [radius](P p) { return 1e-3 * p.v_mm * p.v_mm / (radius * radius) * p.cos; })};
}

Shape spike_shape(bool first, double decay_mm) {
    return [first, decay_mm](const CirclePoint& p) {
        const double travelled = first ? p.reversal_u_mm : p.reversal_v_mm;
        const double along = first ? p.cos * p.travel_u : p.sin * p.travel_v;
        return -1e-3 * along * std::exp(-travelled / decay_mm);
    };
}

Shape ripple_shape(bool first, double period_mm, bool sine) {
    return [first, period_mm, sine](const CirclePoint& p) {
        const double angle = 2.0 * pi * (first ? p.machine_u_mm : p.machine_v_mm) / period_mm;
        return 1e-3 * (sine ? std::sin(angle) : std::cos(angle)) * (first ? p.cos : p.sin);
    };
}

/// Least squares with columns added one after the other, so that the gain of each is known at once.
class ShapeFit {
  public:
    explicit ShapeFit(const std::vector<CirclePoint>& points) : points_(points) {
        rest_.resize(static_cast<Eigen::Index>(points.size()));
        for (std::size_t i = 0; i < points.size(); ++i)
            rest_(static_cast<Eigen::Index>(i)) = points[i].radial_mm;
    }

    Eigen::VectorXd column(const Shape& shape) const {
        Eigen::VectorXd out(static_cast<Eigen::Index>(points_.size()));
        for (std::size_t i = 0; i < points_.size(); ++i)
            out(static_cast<Eigen::Index>(i)) = shape(points_[i]);
        return out;
    }

    /// Remainder of a column after projecting out those taken; empty when it vanishes.
    Eigen::VectorXd beside(const Eigen::VectorXd& column) const {
        Eigen::VectorXd left = column;
        for (int pass = 0; pass < 2; ++pass)
            for (const Eigen::VectorXd& q : basis_) left -= q.dot(left) * q;
        if (left.norm() < 1e-4 * column.norm() || left.norm() == 0.0) return {};
        return left;
    }

    bool add(const Term& term) {
        const Eigen::VectorXd full = column(term.shape), left = beside(full);
        if (left.size() == 0) return false;
        basis_.push_back(left.normalized());
        rest_ -= basis_.back().dot(rest_) * basis_.back();
        columns_.push_back(full);
        terms_.push_back(term);
        return true;
    }

    /// Sum of squares that these traces would explain.
    double gain(const std::vector<Shape>& shapes) const {
        double sum = 0.0;
        Eigen::VectorXd first;
        for (const Shape& shape : shapes) {
            Eigen::VectorXd left = beside(column(shape));
            if (left.size() == 0) continue;
            if (first.size() > 0) left -= first.dot(left) * first;
            if (left.norm() == 0.0) continue;
            left.normalize();
            sum += std::pow(left.dot(rest_), 2);
            first = left;
        }
        return sum;
    }

    double variance() const {
        const auto dof = rest_.size() - static_cast<Eigen::Index>(basis_.size());
        return dof > 0 ? rest_.squaredNorm() / static_cast<double>(dof) : 0.0;
    }

    /// Values and uncertainties of all terms taken, with their traces.
    std::vector<CircularCause> solve() const {
        const auto count = static_cast<Eigen::Index>(columns_.size());
        Eigen::MatrixXd a(static_cast<Eigen::Index>(points_.size()), count);
        for (Eigen::Index k = 0; k < count; ++k)
            a.col(k) = columns_[static_cast<std::size_t>(k)] /
                       columns_[static_cast<std::size_t>(k)].norm();
        Eigen::VectorXd y(a.rows());
        for (Eigen::Index i = 0; i < y.size(); ++i)
            y(i) = points_[static_cast<std::size_t>(i)].radial_mm;
        const Eigen::LDLT<Eigen::MatrixXd> solver(a.transpose() * a);
        const Eigen::VectorXd x = solver.solve(a.transpose() * y);
        const Eigen::MatrixXd cofactor = solver.solve(Eigen::MatrixXd::Identity(count, count));
        std::vector<CircularCause> causes;
        for (Eigen::Index k = 0; k < count; ++k) {
            const Term& term = terms_[static_cast<std::size_t>(k)];
            if (term.nuisance) continue;
            const Eigen::VectorXd& shape = columns_[static_cast<std::size_t>(k)];
            CircularCause cause = term.cause;
            cause.value = x(k) / shape.norm();
            cause.sigma = std::sqrt(variance() * cofactor(k, k)) / shape.norm();
            const Eigen::VectorXd trace = cause.value * centred(shape);
            cause.share_um = um_from_mm(trace.maxCoeff() - trace.minCoeff());
            cause.significant = std::abs(cause.value) > 3.0 * cause.sigma;
            causes.push_back(cause);
        }
        return causes;
    }

    double residual_um() const { return um_from_mm(std::sqrt(variance())); }

  private:
    /// Removes shift and change of radius of the circle, which are not circularity.
    Eigen::VectorXd centred(Eigen::VectorXd shape) const {
        for (std::size_t k = 0; k < terms_.size(); ++k)
            if (terms_[k].nuisance) shape -= basis_[k].dot(shape) * basis_[k];
        return shape;
    }

    const std::vector<CirclePoint>& points_;
    std::vector<Eigen::VectorXd> basis_, columns_;
    std::vector<Term> terms_;
    Eigen::VectorXd rest_;
};

std::string number(double value) {
    std::string text = std::to_string(value);
    return text.substr(0, text.find('.') + 3);
}

/// Best of a grid of decay lengths; taken when it explains far more than noise would.
void try_spike(ShapeFit& fit, bool first, const std::string& axis) {
    double best_gain = 0.0, best_mm = 0.0;
    const auto look = [&](double low, double high, double factor) {
        for (double decay = low; decay < high; decay *= factor) {
            const double gain = fit.gain({spike_shape(first, decay)});
            if (gain > best_gain) best_gain = gain, best_mm = decay;
        }
    };
    look(0.1, 20.0, 1.15);
    look(best_mm / 1.15, best_mm * 1.15, 1.01);
    if (best_gain <= full_weight_gain * fit.variance()) return;
    Term found =
        term("reversal spike " + axis, axis + ".reversal_spike", "um", spike_shape(first, best_mm));
    found.cause.note = "decay " + number(best_mm) + " mm";
    fit.add(found);
}

void try_ripple(ShapeFit& fit, bool first, const std::string& axis) {
    double best_gain = 0.0, best_mm = 0.0;
    const auto look = [&](double low, double high, double factor) {
        for (double period = low; period < high; period *= factor) {
            const double gain =
                fit.gain({ripple_shape(first, period, false), ripple_shape(first, period, true)});
            if (gain > best_gain) best_gain = gain, best_mm = period;
        }
    };
    look(2.0, 50.0, 1.004);
    look(best_mm / 1.004, best_mm * 1.004, 1.0002);
    if (best_gain <= 2.0 * full_weight_gain * fit.variance()) return;
    for (const bool sine : {false, true}) {
        Term found = term("cyclic error " + axis, axis + ".cyclic", "um",
                          ripple_shape(first, best_mm, sine));
        found.cause.note = "pitch " + number(best_mm) + " mm, " + (sine ? "sine" : "cosine");
        fit.add(found);
    }
}

/// Combines cosine and sine of one ripple into its amplitude.
void join_ripples(std::vector<CircularCause>& causes) {
    for (std::size_t i = 0; i + 1 < causes.size(); ++i) {
        CircularCause &a = causes[i], &b = causes[i + 1];
        if (a.name != b.name) continue;
        const double amplitude = std::hypot(a.value, b.value);
        a.share_um = amplitude > 0.0 ? std::hypot(a.share_um, b.share_um) : 0.0;
        a.sigma = std::max(a.sigma, b.sigma);
        a.value = amplitude;
        a.significant = a.value > 3.0 * a.sigma;
        a.note = a.note.substr(0, a.note.find(','));
        causes.erase(causes.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
}

void rank_causes(std::vector<CircularCause>& causes) {
    double total = 0.0;
    for (const CircularCause& cause : causes) total += cause.share_um;
    std::stable_sort(
        causes.begin(), causes.end(),
        [](const CircularCause& a, const CircularCause& b) { return a.share_um > b.share_um; });
    int rank = 0;
    for (CircularCause& cause : causes) {
        cause.rank = ++rank;
        cause.share = total > 0.0 ? cause.share_um / total : 0.0;
    }
}

}  // namespace

CircularDiagnosis diagnose_circle(const CircularTest& test) {
    CircularDiagnosis out;
    const std::vector<CirclePoint> points = points_of(test);
    if (points.size() < 30) return out;
    const auto [u, v] = axes_of_plane(test.plane);
    ShapeFit fit(points);
    for (const Term& t : plain_terms(test))
        if (!fit.add(t)) out.not_separable.push_back(t.cause.name);
    for (const bool first : {true, false}) {
        const std::string axis(1, letter_of(first ? u : v));
        try_spike(fit, first, axis);
        try_ripple(fit, first, axis);
    }
    out.causes = fit.solve();
    out.residual_um = fit.residual_um();
    join_ripples(out.causes);
    rank_causes(out.causes);
    return out;
}

}  // namespace trunnion::ballbar::test
