#include <fmt/format.h>

#include <algorithm>

#include "diagnosis/diagnoser.h"
#include "base/alarm.h"

namespace trunnion {

Diagnoser::Diagnoser(const Setup& setup, const ReadingTable& table, const DiagnosisOptions& options)
    : table_(table),
      options_(options),
      replay_(setup, table),
      catalogue_(make_catalogue(setup, extent_of(setup, table))) {
    refuse_poor_tables();
    base_ = fit_base(setup, table, replay_, catalogue_, setup.model.modelled);
    if (options.holdout) refuse_poor_holdout(*options.holdout);
    blocks_ = noise_blocks(replay_, table);
    folds_ = make_folds(blocks_, replay_.size());
    used_.assign(replay_.size(), true);
    sigma_mm_ = base_.sigma_mm;
}

Diagnosis Diagnoser::run() {
    start_noise();
    watch("sensitivities of all effects");
    build_design();
    drop_outliers();
    watch("search among sets of effects");
    set_ = best_set();
    refine_noise();
    refine_set();
    refine_noise();
    for (int pass = 0; pass < 3 && relinearise(); ++pass) {
    }
    prune();
    watch("what else it may be");
    add_alternatives();
    settle();
    finish_keys();
    watch("held-out readings");
    judge();
    return std::move(result_);
}

void Diagnoser::refuse_poor_tables() const {
    if (replay_.size() < 12)
        throw InputError(fmt::format("{} readings allow no diagnosis", replay_.size()),
                         {table_.path, 0, 0});
}

void Diagnoser::refuse_poor_holdout(const ReadingTable& table) const {
    constexpr double absurd_mm = 5.0;
    const Replay replay(base_.setup, table);
    const std::vector<double> read = replay.predict(base_.models);
    if (replay.size() == 0) throw InputError("no held-out reading", {table.path, 0, 0});
    for (std::size_t i = 0; i < replay.size(); ++i) {
        const Reading& row = table.rows[replay.table_row(i)];
        if (!row.value_mm)
            throw InputError("a held-out row with a device but without value_mm",
                             place_of(table, row));
        if (std::abs(*row.value_mm - read[i]) > absurd_mm)
            throw InputError(fmt::format("held out, {:.3g} mm away from what the simulation reads: "
                                         "wrong units (um for mm?), wrong frame, another machine",
                                         *row.value_mm - read[i]),
                             place_of(table, row));
    }
}

void Diagnoser::start_noise() {
    noise_.source = base_.noise_given ? NoiseSource::given : NoiseSource::assumed;
    noise_ = noise_from_repeats(replay_, table_, blocks_, base_.residual_mm, sigma_mm_, noise_);
    rewhiten();
}

void Diagnoser::rewhiten() {
    whitener_.emplace(replay_, blocks_, noise_, sigma_mm_);
    if (design_) design_->rewhiten(*whitener_);
}

bool Diagnoser::modelled(const Effect& effect) const {
    const auto& names = base_.setup.model.modelled;
    return effect.name == "location" ||
           std::find(names.begin(), names.end(), effect.name) != names.end();
}

const char* to_string(Verdict verdict) {
    switch (verdict) {
        case Verdict::no_gap:
            return "no-gap";
        case Verdict::explained:
            return "explained";
        case Verdict::partly_explained:
            return "partly-explained";
        case Verdict::ambiguous:
            return "ambiguous";
        case Verdict::unexplained:
            return "unexplained";
    }
    return "";
}

const char* to_string(NoiseSource source) {
    return source == NoiseSource::repeats ? "repeats"
           : source == NoiseSource::given ? "given"
                                          : "assumed";
}

Diagnosis diagnose(const Setup& setup, const ReadingTable& table, const DiagnosisOptions& options) {
    return Diagnoser(setup, table, options).run();
}

}  // namespace trunnion
