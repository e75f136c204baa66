// What is written beside what is found: made-up columns on the rows of a real campaign.
#include <algorithm>
#include <catch2/catch.hpp>

#include "diagnosis/doubted.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/left_out.h"
#include "diagnosis/search/solution.h"
#include "diagnosis/written_setup.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

using diagnosis::GroupKind;

/// Passes of the ballbar, and random set-up columns in place of the real ones.
struct Rows {
    setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = readings(setup);
    diagnosis::Prepared prepared = diagnosis::prepare(setup, table);
    Eigen::Index count = static_cast<Eigen::Index>(prepared.replay.size());
    std::vector<bool> used = std::vector<bool>(prepared.replay.size(), true);
    SeededNoise random{17};

    static records::ReadingTable readings(const setup::Setup& setup) {
        records::ReadingTable table = campaign::empty_table(setup);
        campaign::add_ballbar(table, setup, 36);
        return campaign::measured(setup, table, 5);
    }
    Eigen::MatrixXd noise(Eigen::Index columns) {
        Eigen::MatrixXd m(count, columns);
        for (Eigen::Index c = 0; c < columns; ++c)
            for (Eigen::Index r = 0; r < count; ++r) m(r, c) = random.normal();
        return m;
    }
    diagnosis::Design design(const Eigen::VectorXd& data) {
        return {noise(prepared.base.columns.cols()), data, static_cast<double>(count)};
    }
    const effects::Effect& effect(const char* name) const {
        return *std::find_if(prepared.catalogue.begin(), prepared.catalogue.end(),
                             [&](const effects::Effect& e) { return e.name == name; });
    }
};

std::size_t add(diagnosis::Design& design, diagnosis::ColumnGroup group,
                const Eigen::MatrixXd& columns) {
    const Eigen::Index first = design.add_features(columns);
    for (Eigen::Index k = 0; k < columns.cols(); ++k) group.features.push_back(first + k);
    if (group.kind == GroupKind::table)
        group.shape = Eigen::MatrixXd::Identity(columns.cols(), columns.cols());
    if (group.effect) {
        group.name = group.effect->name;
        group.parameters = {0};
        group.keys = group.effect->zeros();
    }
    return design.add(std::move(group));
}

diagnosis::ColumnGroup of_kind(GroupKind kind, const effects::Effect* effect) {
    diagnosis::ColumnGroup group;
    group.kind = kind;
    group.effect = effect;
    return group;
}

const diagnosis::NoiseBelief plain_noise{{}, {0.0, 0.1}, 1e300};

diagnosis::Model fitted(diagnosis::Design& design, std::vector<std::size_t> members) {
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, plain_noise.prior);
    const std::vector<double> start(members.size(), 1.0);
    return diagnosis::tuned(design, setting, {std::move(members), {start, 1.0}, 0.0}, 5);
}

diagnosis::Judgement judged(const Rows& rows, diagnosis::Design& design,
                            const diagnosis::Model& model,
                            const diagnosis::NoiseBelief& noise = plain_noise) {
    diagnosis::FoldColumns columns(design, {rows.prepared.folds, rows.used});
    return diagnosis::judged(columns, rows.prepared, model, noise);
}

std::vector<std::size_t> written(const Rows& rows, diagnosis::Design& design,
                                 const diagnosis::Model& model,
                                 const diagnosis::Judgement& judgement) {
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, plain_noise.prior);
    return diagnosis::written_setup({rows.prepared, design, setting, model, judgement, plain_noise,
                                     rows.used, rows.used, diagnosis::Challenged{}})
        .model.members;
}

bool writes(const Rows& rows, diagnosis::Design& design, const diagnosis::Model& model,
            const diagnosis::Judgement& judgement) {
    const auto list = written(rows, design, model, judgement);
    return std::find(list.begin(), list.end(), model.members.front()) != list.end();
}

}  // namespace

TEST_CASE("a drift beside another course of time is not written", "[diagnosis][written]") {
    Rows rows;
    const Eigen::MatrixXd drift = rows.noise(1), course = rows.noise(1);
    diagnosis::Design design =
        rows.design(5.0 * drift.col(0) + 2.0 * course.col(0) + rows.noise(1).col(0));
    const std::size_t cause =
        add(design, of_kind(GroupKind::periodic, &rows.effect("thermal.drift")), drift);
    for (const bool of_time : {true, false}) {
        diagnosis::ColumnGroup group = of_kind(GroupKind::driver, nullptr);
        group.of_time = of_time;
        const diagnosis::Model model = fitted(design, {cause, add(design, group, course)});
        const diagnosis::Judgement judgement = judged(rows, design, model);
        INFO(of_time);
        CHECK(judgement.interpolates[0] != of_time);
        CHECK(writes(rows, design, model, judgement) != of_time);
    }
}

// A play of 240 um beside a gap of a tenth of it: few readings show it, and other readings refute
// it.
TEST_CASE("what is many times the usual size is written only where it is claimed",
          "[diagnosis][written]") {
    Rows rows;
    const Eigen::MatrixXd backlash = rows.noise(1);
    for (const double size : {0.8, 1.2})
        for (const double probability : {0.49, 0.5}) {
            const Eigen::MatrixXd column = backlash / (size * diagnosis::rules::enormous);
            diagnosis::Design design = rows.design(5.0 * backlash.col(0) + rows.noise(1).col(0));
            const std::size_t cause =
                add(design, of_kind(GroupKind::textbook, &rows.effect("C.backlash")), 5.0 * column);
            const diagnosis::Model model = fitted(design, {cause});
            const diagnosis::Judgement judgement = judged(rows, design, model);
            REQUIRE(judgement.interpolates[0]);
            const diagnosis::SearchSetting setting =
                diagnosis::search_setting(design, plain_noise.prior);
            diagnosis::Claim claim;
            claim.name = "C.backlash";
            claim.probability = probability;
            claim.own = claim.share = 1.0;
            const auto less =
                diagnosis::doubted({rows.prepared, design, setting, model, judgement, plain_noise,
                                    rows.used, rows.used, diagnosis::Challenged{}},
                                   {claim});
            INFO(size << " of the limit, probability " << probability);
            REQUIRE(less.has_value() == (size > 1.0 && probability < 0.5));
            if (!less) continue;
            CHECK_FALSE(less->between_places);
            CHECK_FALSE(writes(rows, design, model, *less));
            CHECK(writes(rows, design, model, judgement));
        }
}

TEST_CASE("causes that do little of a gap do not explain it", "[diagnosis][written]") {
    Rows rows;
    const Eigen::MatrixXd backlash = rows.noise(1);
    diagnosis::Design design = rows.design(5.0 * backlash.col(0) + rows.noise(1).col(0));
    const std::size_t cause =
        add(design, of_kind(GroupKind::textbook, &rows.effect("C.backlash")), backlash);
    const diagnosis::Model model = fitted(design, {cause});
    const diagnosis::Judgement judgement = judged(rows, design, model);
    const diagnosis::SearchSetting setting = diagnosis::search_setting(design, plain_noise.prior);
    REQUIRE(judgement.part > 0.8);
    const double limit = diagnosis::rules::least_told * judgement.part;
    for (const double share : {0.0, 0.99 * limit, 1.01 * limit, 1.0}) {
        diagnosis::Claim claim;
        claim.name = "C.backlash";
        claim.probability = 0.9;
        claim.share = share;
        const auto less =
            diagnosis::doubted({rows.prepared, design, setting, model, judgement, plain_noise,
                                rows.used, rows.used, diagnosis::Challenged{}},
                               {claim});
        INFO(share);
        REQUIRE(less.has_value() == (share < limit));
        if (less) CHECK(less->part == share);
    }
}

// Without the table that is not written, a play takes its place, because it looks like it a little.
TEST_CASE("what becomes many times the usual size where another cause is not written goes, too",
          "[diagnosis][written]") {
    Rows rows;
    const Eigen::MatrixXd table = rows.noise(1);
    for (const double size : {0.5, 2.0}) {
        diagnosis::Design design = rows.design(5.0 * table.col(0) + rows.noise(1).col(0));
        const Eigen::MatrixXd like_it =
            (5.0 * table + rows.noise(1)) / (size * diagnosis::rules::enormous);
        const std::size_t play =
            add(design, of_kind(GroupKind::textbook, &rows.effect("C.backlash")), like_it);
        const std::size_t form = add(design, of_kind(GroupKind::table, nullptr), table);
        diagnosis::Model model = fitted(design, {form});
        model.members.push_back(play);
        model.variances.tau.push_back(1e-3);
        diagnosis::Judgement judgement = judged(rows, design, model);
        judgement.interpolates = {false, true};
        INFO(size << " of the limit");
        REQUIRE(diagnosis::usual_sizes(design, model)[1] < 1.0);
        const auto list = written(rows, design, model, judgement);
        CHECK((std::find(list.begin(), list.end(), play) != list.end()) == (size < 1.0));
    }
}

TEST_CASE("a cause that removes less than half of the gap is not written", "[diagnosis][written]") {
    Rows rows;
    const Eigen::MatrixXd backlash = rows.noise(1);
    const diagnosis::NoiseBelief noise{{}, {0.0, 0.1}, 1.2};  // more than this is no noise
    for (const double size : {1.0, 5.0}) {
        diagnosis::Design design = rows.design(size * backlash.col(0) + 2.0 * rows.noise(1).col(0));
        const diagnosis::Model model = fitted(
            design,
            {add(design, of_kind(GroupKind::textbook, &rows.effect("C.backlash")), backlash)});
        const diagnosis::Judgement judgement = judged(rows, design, model, noise);
        INFO(size);
        REQUIRE(judgement.gap);
        CHECK((judgement.part < 0.5) == (size < 2.0));
        CHECK(writes(rows, design, model, judgement) == (size > 2.0));
    }
}

TEST_CASE("passes of a ballbar are one path where all axes have the same end positions",
          "[diagnosis][written]") {
    Rows rows;
    const auto fold_of = [&](double turn_rad, double way_mm) {
        records::ReadingTable table = campaign::empty_table(rows.setup);
        std::vector<diagnosis::NoiseBlock> blocks;
        for (const bool other : {false, true}) {
            blocks.push_back({records::Device::ballbar, {}});
            for (int k = 0; k <= 10; ++k) {
                records::Reading row = rows.table.rows.front();
                row.device = records::Device::ballbar;
                row.time_s = static_cast<double>(table.rows.size());
                row.commanded[Axis::C] = 0.1 * k * (other ? turn_rad : 0.5);
                row.commanded[Axis::X] = 0.1 * k * (other ? way_mm : 100.0);
                blocks.back().rows.push_back(static_cast<Eigen::Index>(table.rows.size()));
                table.rows.push_back(row);
            }
        }
        const emulator::Replay replay(rows.setup, table);
        return diagnosis::path_folds(blocks, replay, table.axes).fold;
    };
    CHECK(fold_of(0.5, 100.0) == std::vector<int>{0, 0});
    CHECK(fold_of(0.504, 100.4) == std::vector<int>{0, 0});  // the same to 1 mm and 0.01 rad
    CHECK(fold_of(0.6, 100.0) == std::vector<int>{0, 1});
    CHECK(fold_of(-0.5, 100.0) == std::vector<int>{0, 1});
    CHECK(fold_of(0.5, 103.0) == std::vector<int>{0, 1});
}

// Each value of the table is seen by one path alone: passes left out are predicted, paths are not.
TEST_CASE("a free form is not written where other paths know nothing of it",
          "[diagnosis][written]") {
    Rows rows;
    const diagnosis::Folds paths =
        diagnosis::path_folds(rows.prepared.blocks, rows.prepared.replay, rows.prepared.table.axes);
    const Eigen::MatrixXd everywhere = rows.noise(1);
    Eigen::MatrixXd of_one_path = rows.noise(diagnosis::Folds::count);
    for (Eigen::Index i = 0; i < rows.count; ++i) {
        const auto block = static_cast<std::size_t>(paths.group[static_cast<std::size_t>(i)]);
        for (Eigen::Index k = 0; k < of_one_path.cols(); ++k)
            if (k != paths.fold[block]) of_one_path(i, k) = 0.0;
    }
    for (const bool known_elsewhere : {false, true}) {
        const Eigen::MatrixXd form =
            known_elsewhere ? Eigen::MatrixXd(of_one_path.rowwise().sum()) : of_one_path;
        diagnosis::Design design = rows.design(5.0 * everywhere.col(0) +
                                               2.0 * form.rowwise().sum() + rows.noise(1).col(0));
        const std::size_t cause =
            add(design, of_kind(GroupKind::textbook, &rows.effect("C.backlash")), everywhere);
        const diagnosis::Model alone = fitted(design, {cause});
        diagnosis::Judgement judgement = judged(rows, design, alone);
        judgement.interpolates.push_back(true);
        judgement.large.push_back(false);
        const std::size_t table = add(design, of_kind(GroupKind::table, nullptr), form);
        const auto list = written(rows, design, fitted(design, {cause, table}), judgement);
        INFO(known_elsewhere);
        CHECK(std::find(list.begin(), list.end(), cause) != list.end());
        CHECK((std::find(list.begin(), list.end(), table) != list.end()) == known_elsewhere);
    }
}

// A set-up value that one path alone determines: left out, that path is missed by more than the
// gap.
TEST_CASE("beside free forms a cause is not written where paths are missed by more than the gap",
          "[diagnosis][written]") {
    Rows rows;
    const diagnosis::Folds paths =
        diagnosis::path_folds(rows.prepared.blocks, rows.prepared.replay, rows.prepared.table.axes);
    Eigen::MatrixXd set_up = rows.noise(rows.prepared.base.columns.cols());
    for (Eigen::Index i = 0; i < rows.count; ++i)
        if (paths.fold[static_cast<std::size_t>(paths.group[static_cast<std::size_t>(i)])] != 0)
            set_up(i, 0) = 0.0;
    const Eigen::MatrixXd form = rows.noise(1);
    for (const double missed : {0.0, 10.0}) {
        const Eigen::VectorXd shown = 5.0 * rows.noise(1).col(0) + 2.0 * missed * set_up.col(0);
        // So much of the gap that the known form alone does not explain it.
        const Eigen::VectorXd curve = (missed > 0.0 ? 6.0 : 3.0) * form.col(0);
        diagnosis::Design design{set_up,
                                 shown + curve + missed * set_up.col(0) + rows.noise(1).col(0),
                                 static_cast<double>(rows.count)};
        const std::size_t cause =
            add(design, of_kind(GroupKind::textbook, &rows.effect("C.backlash")), shown);
        diagnosis::Judgement judgement = judged(rows, design, fitted(design, {cause}));
        judgement.interpolates.push_back(false);
        judgement.large.push_back(false);
        const std::size_t table = add(design, of_kind(GroupKind::table, nullptr), form);
        INFO(missed);
        CHECK(writes(rows, design, fitted(design, {cause, table}), judgement) == (missed == 0.0));
    }
}

// The other paths see a thousandth of it, and what their noise says is wrong: predicted from them,
// the path is missed by more than without the effect, as the model itself expects.
TEST_CASE("an effect that a single path shows is written where known forms explain the gap",
          "[diagnosis][written]") {
    Rows rows;
    const diagnosis::Folds paths =
        diagnosis::path_folds(rows.prepared.blocks, rows.prepared.replay, rows.prepared.table.axes);
    Eigen::VectorXd shown(rows.count), elsewhere = Eigen::VectorXd::Zero(rows.count);
    for (Eigen::Index i = 0; i < rows.count; ++i) {
        const auto block = static_cast<std::size_t>(paths.group[static_cast<std::size_t>(i)]);
        const bool path = paths.fold[block] == 0;
        shown(i) = path ? 10.0 : 0.01 * rows.random.normal();
        if (!path) elsewhere(i) = shown(i);
    }
    constexpr double size = 3.0;
    constexpr double said_elsewhere = -1.5;  // 1.7 of its sigma there off
    Eigen::VectorXd data = size * shown + rows.noise(1).col(0);
    data += (said_elsewhere - elsewhere.dot(data) / elsewhere.squaredNorm()) * elsewhere;
    diagnosis::Design design = rows.design(data);
    const std::size_t cause =
        add(design, of_kind(GroupKind::textbook, &rows.effect("C.backlash")), shown);
    const std::size_t table = add(design, of_kind(GroupKind::table, nullptr), rows.noise(1));
    diagnosis::Model model = fitted(design, {cause});
    diagnosis::Judgement judgement = judged(rows, design, model);
    REQUIRE(judgement.part > 0.9);
    CHECK(writes(rows, design, model, judgement));
    model = fitted(design, {cause, table});  // a table that does nothing, and is not written
    judgement.interpolates.push_back(false);
    judgement.large.push_back(false);
    CHECK(writes(rows, design, model, judgement));
    judgement.interpolates.pop_back();
    judgement.large.pop_back();
    model = fitted(design, {cause});
    judgement.part = 0.7;  // much is missing
    CHECK_FALSE(writes(rows, design, model, judgement));
}

}  // namespace trunnion
