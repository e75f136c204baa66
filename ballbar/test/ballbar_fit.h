// Exact least-squares fit of the ballbar's length to all tests simultaneously: values, covariance,
// rank, inseparable parameters.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "ballbar/test/ballbar_tests.h"
#include "base/finite.h"
#include "kinematics/machine.h"
#include "records/readings.h"

namespace trunnion::ballbar::test {

/// Additional unknowns of the readings: none, an error of the bar's length (value = distance -
/// nominal - error), or a constant for each test (drift between tests, a new set-up).
enum class BarConstant : unsigned char { none, length, per_test };

/// Knowledge of the centre pivot: an approximate position only; its position on the table (W); or
/// that it was clamped at the spindle with the rotary axes at zero, so that its position in M is
/// known then and errors of the axes appear only when they turn (ballbar 2015, docs/ballbar.md).
enum class PivotPlace : unsigned char { unknown, on_table, at_spindle };

struct BallbarUnknowns {
    bool cup = false;  ///< tool length and cup run-out unknown: reduces the rank by three
    PivotPlace pivot = PivotPlace::unknown;
    BarConstant constant = BarConstant::length;
};

struct BallbarParameter {
    enum class Kind : unsigned char { location, cup, pivot, length, test_constant };
    Kind kind = Kind::location;
    kinematics::ErrorName error;  ///< kind `location`: the error
    int component = 0;            ///< x y z of cup (S) or pivot (W); number of the test
    std::string name;  ///< "EY0A", "ballbar.cup.x", "ballbar.pivot.z", "ballbar.length", ...

    bool angular() const { return kind == Kind::location && error.angular(); }
};

/// Parameters that can change together without changing any reading.
struct InseparableGroup {
    std::vector<std::string> names;
    std::vector<double> direction;  ///< mm and rad, largest entry 1
};

struct BallbarFit {
    std::vector<BallbarParameter> parameters;
    Eigen::VectorXd value;     ///< mm and rad, relative to the start; smallest norm where not
                               ///< determined
    Eigen::MatrixXd cofactor;  ///< covariance for readings of unit variance, of the determined part
    int rank = 0;
    std::vector<InseparableGroup> inseparable;
    std::vector<double> residual_mm;  ///< reading - model, in the order of the rows used
    double rms_mm = 0.0;              ///< sqrt(sum of squares / dof)
    double noise_mm = 0.0;  ///< from differences of neighbouring residuals, so without slow
                            ///< structure
    int dof = 0;
    int iterations = 0;

    int find(const std::string& name) const;  ///< -1: not a parameter
    bool determined(int parameter) const;     ///< false: part of an inseparable group
};

struct BallbarState;  // one set of parameter values, prepared for evaluation

/// The length model at fixed poses: distance between tool cup and centre pivot on the physical
/// chain, minus the nominal length. Prepared once for many sets of readings.
class BallbarModel {
  public:
    /// `nominal`: known geometry of the machine (usually without errors); `rows`: all ballbar
    /// passes.
    BallbarModel(const kinematics::Machine& nominal, const BallbarLayout& layout,
                 const std::vector<records::Reading>& rows, const BallbarUnknowns& unknowns);

    std::size_t size() const { return poses_.size(); }
    const std::vector<BallbarParameter>& parameters() const { return parameters_; }
    /// Index of each reading used, in the rows given.
    const std::vector<std::size_t>& rows_used() const { return row_; }
    const std::vector<BallbarPass>& passes() const { return passes_; }

    /// Readings (mm) for these parameter values.
    std::vector<double> predict(const Eigen::VectorXd& value) const;
    /// Gauss-Newton from zero. `reading_mm` in the order of rows_used(). Inseparable parameters
    /// take the smallest values; `inseparable` lists them.
    BallbarFit fit(const std::vector<double>& reading_mm) const;

  private:
    /// Neighbouring readings share the Jacobian row of their middle one, because it hardly changes
    /// at 1000 Hz. Residuals are always exact.
    struct Block {
        std::size_t begin, end;
    };
    struct Linear {
        Eigen::MatrixXd jacobian;  ///< one row a block, scaled columns
        Eigen::MatrixXd inverse;   ///< pseudo-inverse of the normal matrix
        Eigen::MatrixXd null;      ///< basis of the null space
    };

    double reading(const BallbarState& state, std::size_t i) const;
    BallbarState state(const Eigen::VectorXd& scaled) const;
    Eigen::MatrixXd jacobian(const Eigen::VectorXd& scaled) const;
    Linear linearise(const Eigen::VectorXd& scaled) const;

    kinematics::Machine nominal_;
    BallbarLayout layout_;
    PivotPlace pivot_place_;
    std::vector<BallbarParameter> parameters_;
    Eigen::VectorXd scale_;
    std::vector<BallbarPass> passes_;
    std::vector<std::size_t> row_;
    std::vector<AxisPositions> poses_;
    std::vector<int> test_of_;           ///< number of the test of each pose
    std::vector<std::size_t> pass_end_;  ///< index of the first pose after each pass
    std::vector<Block> blocks_;
    Linear start_;  ///< at zero errors, where symmetries are exact
};

/// Standard uncertainty of one reading: from the residuals, but at least the declared one.
double reading_sigma_mm(const BallbarFit& fit, double declared_mm);

/// Whether the residuals contain more than noise, i.e. slow structure larger than twice its own
/// scatter. Causes that are not modelled (linear axes, backlash, servo, ...) appear here.
struct ResidualVerdict {
    bool structured = false;
    Finite excess_um = 0.0;  ///< sqrt(rms^2 - noise^2)
    std::string worst_test;  ///< pass with the largest rms
    Finite worst_rms_um = 0.0;
};
ResidualVerdict judge_residuals(const BallbarModel& model, const BallbarFit& fit);

}  // namespace trunnion::ballbar::test
