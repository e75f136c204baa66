#include "report/identification_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/rounded.h"
#include "base/units.h"
#include "report/diagnosis_words.h"
#include "report/identification_report.h"
#include "report/scatter.h"

namespace trunnion::report {
namespace {

using identification::FitParameter;

std::string interval(const FitParameter& p) {
    if (!std::isfinite(p.sigma)) return "not seen";
    FitParameter low = p, high = p;
    low.value = low.value - 1.96 * p.sigma;
    high.value = high.value + 1.96 * p.sigma;
    const ShopValue from = shop_value(low), to = shop_value(high);
    return from.unit == to.unit ? from.value + " to " + to.value : std::string("-");
}

/// Zero lies outside the 95 % interval.
bool is_beyond_noise(const FitParameter& p) {
    return std::isfinite(p.sigma) && std::abs(p.value) > 1.96 * p.sigma;
}

PageTable values_table(const identification::Identification& result) {
    PageTable table{
        "", {"effect", "parameter", "value", "u", "95 % interval", "unit", ""}, "llrrrll", {}};
    table.header.back() = "beyond noise";
    for (const FitParameter& p : result.parameters) {
        const ShopValue v = shop_value(p);
        table.rows.push_back({p.effect, v.name, v.value, v.sigma, interval(p), v.unit,
                              p.of_set_up          ? "–"
                              : is_beyond_noise(p) ? "yes"
                                                   : "no"});
    }
    return table;
}

/// The errors of the machine beyond their noise, the one with the most sigmas first.
std::string errors_words(const identification::Identification& result) {
    std::vector<FitParameter> errors = result.parameters;
    std::erase_if(errors, [](const FitParameter& p) { return p.of_set_up; });
    const std::size_t fitted = errors.size();
    std::erase_if(errors, [](const FitParameter& p) { return !is_beyond_noise(p); });
    if (fitted == 0) return {};
    if (errors.empty()) return "No error of the machine is larger than its noise. ";
    const FitParameter& first =
        *std::max_element(errors.begin(), errors.end(), [](const auto& a, const auto& b) {
            return std::abs(a.value) / a.sigma < std::abs(b.value) / b.sigma;
        });
    const ShopValue v = shop_value(first);
    return fmt::format("{} of {} values of the machine are beyond noise, clearest {} {} ± {} {}. ",
                       errors.size(), fitted, v.name, v.value, v.sigma, v.unit);
}

struct Correlation {
    Eigen::Index a = 0, b = 0;
    double value = 0.0;
};

/// Correlations above one half, strongest first.
std::vector<Correlation> correlations(const Eigen::MatrixXd& covariance) {
    std::vector<Correlation> list;
    for (Eigen::Index i = 0; i < covariance.rows(); ++i)
        for (Eigen::Index k = 0; k < i; ++k) {
            const double r = covariance(i, k) / std::sqrt(covariance(i, i) * covariance(k, k));
            if (std::isfinite(r) && std::abs(r) > 0.5) list.push_back({k, i, r});
        }
    std::stable_sort(list.begin(), list.end(), [](const Correlation& a, const Correlation& b) {
        return std::abs(a.value) > std::abs(b.value);
    });
    return list;
}

std::string correlations_section(const identification::Identification& result) {
    constexpr std::size_t most = 20;
    const auto list = correlations(result.covariance);
    std::string body;
    PageTable table{"", {"parameter", "parameter", "correlation"}, "llr", {}};
    const auto name = [&](Eigen::Index k) {
        return full_name(result.parameters[static_cast<std::size_t>(k)]);
    };
    for (std::size_t i = 0; i < std::min(list.size(), most); ++i)
        table.rows.push_back(
            {name(list[i].a), name(list[i].b), fmt::format("{:+.2f}", list[i].value)});
    if (list.empty())
        body = paragraph_html("No two parameters are correlated by more than 0.5.");
    else
        body = table_html(table);
    if (list.size() > most)
        body += paragraph_html(fmt::format("{} more are above 0.5.", list.size() - most));
    for (const identification::Inseparable& group : result.inseparable)
        body += paragraph_html("Not observable from these readings: " + to_string(group) + ".");
    return section_html("What goes together", body);
}

/// Residual of every row with a value, as a function of `place`.
template <typename Place>
std::string residual_figure(const records::ReadingTable& measured,
                            const records::ReadingTable& predicted, const std::string& over,
                            Place place) {
    Scatter scatter;
    scatter.title = "Residuals over " + over;
    scatter.description = "Reading minus prediction of the identified machine.";
    scatter.x_label = over;
    scatter.y_label = "residual / µm, µrad";
    scatter.series.resize(1);
    for (std::size_t i = 0; i < std::min(measured.rows.size(), predicted.rows.size()); ++i) {
        const records::Reading &m = measured.rows[i], &p = predicted.rows[i];
        if (!m.value_mm || !p.value_mm || m.device == records::Device::none) continue;
        const double left = *m.value_mm - *p.value_mm;
        scatter.series[0].points.push_back(
            {place(m), m.angular ? urad_from_rad(left) : um_from_mm(left)});
    }
    return figure_html(scatter_svg(scatter), scatter.title);
}

bool moves(const records::ReadingTable& table, Axis axis) {
    return std::any_of(table.rows.begin(), table.rows.end(), [&](const records::Reading& row) {
        return std::abs(row.commanded[axis] - table.rows.front().commanded[axis]) > 1e-6;
    });
}

std::string residuals_section(const records::ReadingTable& measured,
                              const records::ReadingTable& predicted) {
    if (measured.rows.empty()) return {};
    std::string body = residual_figure(measured, predicted, "time / min",
                                       [](const records::Reading& r) { return r.time_s / 60.0; });
    for (const Axis axis : measured.axes) {
        if (!moves(measured, axis)) continue;
        const bool rotary = measured.names.is_rotary(axis);
        body += residual_figure(
            measured, predicted, measured.names[axis] + (rotary ? " / deg" : " / mm"),
            [&](const records::Reading& r) {
                return rotary ? deg_from_rad(r.commanded[axis]) : r.commanded[axis];
            });
    }
    return section_html("What is left", body);
}

}  // namespace

Page identification_page(const identification::Identification& result,
                         const records::ReadingTable& measured,
                         const records::ReadingTable& predicted) {
    Page page;
    page.title = "Identified errors";
    page.subject = result.setup.name + ", readings " + measured.path;
    const auto unseen = static_cast<std::size_t>(
        std::count_if(result.parameters.begin(), result.parameters.end(),
                      [](const FitParameter& p) { return !std::isfinite(p.sigma); }));
    page.verdict = fmt::format(
        "{}With these values the simulation misses the readings by {} rms, before by {}.{}",
        errors_words(result), size_words(result, result.rms_after_um),
        size_words(result, result.rms_before_um),
        unseen == 0 ? ""
                    : fmt::format(" {} of {} parameters cannot be determined from these readings.",
                                  unseen, result.parameters.size()));
    page.body_html =
        section_html("Values", table_html(values_table(result))) + correlations_section(result) +
        residuals_section(measured, predicted) +
        section_html(
            "How to read this",
            paragraph_html(fmt::format("u is one standard uncertainty; {} degrees of freedom. "
                                       "\"Beyond noise\": zero lies outside the 95 % interval; "
                                       "– for a quantity of the set-up.",
                                       result.dof)) +
                paragraph_html("Residuals that follow an axis or the time are errors that were not "
                               "fitted: diagnose names them."));
    return page;
}

}  // namespace trunnion::report
