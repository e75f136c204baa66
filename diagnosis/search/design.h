// Whitened columns of all groups, set-up projected out, with the products required by a search.
//
// Rows        whitened readings, then one row for each calibrated value of the set-up (a known
// value
//             is one more reading).
// Features    derivatives by single parameters, or by knots of a table. A group combines features
//             linearly (ColumnGroup::shape), so that all correlation lengths of a table share one
//             set of knots.
// Products    of two sets of features, and of the columns of two groups, are computed when they are
//             first needed, and kept. Search and solution then use only these small matrices.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "diagnosis/search/column_group.h"
#include "diagnosis/search/held_members.h"
#include "estimation/projection.h"
#include "estimation/variance_groups.h"

namespace trunnion::diagnosis {

class Design {
  public:
    /// `known`: whitened set-up columns; `data`: whitened residuals; `rows`: number of rows that
    /// count.
    Design(Eigen::MatrixXd known, Eigen::VectorXd data, double rows);

    /// Adds whitened features (missing rows are zero); returns the index of the first one.
    Eigen::Index add_features(const Eigen::MatrixXd& white);
    /// Adds a group whose features are in the design; returns the index of the group.
    std::size_t add(ColumnGroup group);
    /// Adds a group made orthogonal to all features below `owned` (those of the textbook effects).
    std::size_t add_beside(ColumnGroup group, Eigen::Index owned);

    /// Features of a list that are adjacent in one block.
    struct Run {
        std::size_t block = 0;
        Eigen::Index at = 0, first = 0, count = 0;  ///< in the list; in the block; features
    };
    struct Entry {
        ColumnGroup group;
        std::vector<Run> runs;    ///< of its features
        Eigen::MatrixXd gram;     ///< of its columns, set-up projected out
        Eigen::VectorXd product;  ///< with the data
        double whole = 0.0;       ///< squared sum of its columns before projection
        bool hidden = false;
        bool only_rival = false;  ///< hidden, but may be named as a rival of a claim
        bool only_form = false;   ///< never offered, but a member may change into it
        std::optional<estimation::ReducedGroup> reduced;  ///< of its gram
        /// True when a typical change moves the readings noticeably and the set-up cannot absorb
        /// it.
        bool moves_readings() const;
        bool visible() const { return !hidden && moves_readings(); }
    };
    const std::vector<Entry>& groups() const { return groups_; }
    const ColumnGroup& group(std::size_t k) const { return groups_[k].group; }

    const Eigen::MatrixXd& known() const { return known_; }
    const Eigen::VectorXd& data() const { return data_; }
    const estimation::Projection& projection() const { return projection_; }
    double rows() const { return rows_; }
    double freedom() const { return rows_ - static_cast<double>(projection_.rank()); }
    /// Whitened columns of a group without projecting out the set-up: rows x columns. Those of a
    /// driver are beside the set-up: a driver predicts nothing, and where it is left out, the
    /// set-up must not lack what both of them can do. Kept: every division into folds needs them.
    const Eigen::MatrixXd& columns(std::size_t group) const;
    /// These columns times coefficients.
    Eigen::VectorXd combined(std::size_t group, const Eigen::VectorXd& coefficients) const;

    estimation::GroupEquations equations(const std::vector<std::size_t>& members);
    /// The members at these variances. The last few are kept: one step of a search often ends with
    /// the model from which the next one starts.
    std::shared_ptr<HeldMembers> held(const std::vector<std::size_t>& members,
                                      const estimation::Variances& variances);
    /// Products of the members' columns with those of other groups, side by side in their order.
    Eigen::MatrixXd cross(const std::vector<std::size_t>& members,
                          const std::vector<std::size_t>& groups);
    /// Products of the features of some groups with the residual of the data after members with
    /// these coefficients; those of other features are not complete.
    Eigen::VectorXd left(const std::vector<std::size_t>& members,
                         const Eigen::VectorXd& coefficients,
                         const std::vector<std::size_t>& groups);
    /// Of these, the products of the columns of one group.
    Eigen::VectorXd of_group(std::size_t group, const Eigen::VectorXd& left) const;
    /// Products of set-up (first) and members, without projection, with each other and with the
    /// data.
    struct Normal {
        Eigen::MatrixXd gram;
        Eigen::VectorXd product;
    };
    Normal normal(const std::vector<std::size_t>& members);
    /// Information and product with the data of single features, independent of groups.
    estimation::GroupInformation of(const std::vector<Eigen::Index>& features) const {
        const std::vector<Run> runs = runs_of(features);
        return {gram_of(runs, runs), product_of(features)};
    }
    /// Excludes the group from further offers.
    void hide(std::size_t group) { groups_[group].hidden = true; }
    void offer_again(std::size_t group) { groups_[group].hidden = false; }
    /// Adds to the log prior of a group.
    void favour(std::size_t group, double log_prior) {
        groups_[group].group.log_prior += log_prior;
    }
    /// Names other keys of a ripple, which may be true as well.
    void leave_open(std::size_t group, std::vector<double> keys) {
        groups_[group].group.open_keys = std::move(keys);
    }
    /// The same as hide(), but it may be named as a rival.
    void keep_as_rival(std::size_t group) {
        groups_[group].hidden = groups_[group].only_rival = true;
    }
    /// The same for angles that are positioning by definition.
    void keep_as_positioning(std::size_t group) {
        keep_as_rival(group);
        groups_[group].group.by_definition = true;
    }
    /// Offers the group in place of another form of its cause alone.
    void keep_as_form(std::size_t group) { groups_[group].only_form = true; }
    /// Fraction of a group's squared columns outside the span of some features
    /// (design_outside.cpp).
    double outside(std::size_t group, const std::vector<Eigen::Index>& features) const;
    /// The same of single features, whatever group they belong to.
    double outside(const std::vector<Eigen::Index>& own,
                   const std::vector<Eigen::Index>& features) const;

  private:
    struct Block {
        Eigen::Index first = 0;
        Eigen::MatrixXd white, coordinates;
        Eigen::SparseMatrix<double> sparse;  ///< the same as `white` if most of it is zero (values
                                             ///< of a table move few readings), else empty
    };
    std::vector<Run> runs_of(const std::vector<Eigen::Index>& features) const;
    std::vector<bool> blocks_with(const std::vector<std::size_t>& groups) const;
    std::size_t block_index(Eigen::Index feature) const;
    const Block& block_of(Eigen::Index feature) const { return blocks_[block_index(feature)]; }
    const Eigen::MatrixXd& between(std::size_t first, std::size_t second) const;
    static Eigen::MatrixXd products_of(const Block& a, const Block& b);
    Eigen::Map<const Eigen::MatrixXd> gathered(const std::vector<Eigen::Index>& list,
                                               Eigen::MatrixXd Block::*part,
                                               Eigen::MatrixXd& storage) const;
    std::size_t append(Entry entry);
    Eigen::MatrixXd worked_out(std::size_t group) const;  ///< columns() of it
    const Eigen::MatrixXd& products(std::size_t first, std::size_t second);
    const Eigen::MatrixXd& coordinates(std::size_t member);
    Eigen::VectorXd product_of(const std::vector<Eigen::Index>& features) const;
    Eigen::MatrixXd gram_of(const std::vector<Run>& a, const std::vector<Run>& b) const;
    const Eigen::MatrixXd& owned_inverse(Eigen::Index owned) const;

    Eigen::MatrixXd known_;
    Eigen::VectorXd data_;
    double rows_;
    estimation::Projection projection_;
    Eigen::VectorXd data_coordinates_;
    Eigen::MatrixXd known_coordinates_;
    Eigen::Index features_ = 0;
    Eigen::VectorXd products_, squares_;  ///< of all features: with the data; squared length
    std::deque<Block> blocks_;  ///< a vector would copy them when it grows: a sparse matrix of
                                ///< Eigen cannot be moved
    std::vector<Entry> groups_;
    using Pair = std::pair<std::size_t, std::size_t>;
    mutable std::map<Pair, Eigen::MatrixXd>
        between_;                                  ///< of blocks, the first not after the second
    std::map<Pair, Eigen::MatrixXd> products_of_;  ///< of groups, likewise
    mutable std::map<std::size_t, Eigen::MatrixXd> columns_;  ///< of groups
    std::deque<std::shared_ptr<HeldMembers>> held_;           ///< the last one first
    std::map<std::size_t, Eigen::MatrixXd> coordinates_;      ///< of members: inside the set-up
    mutable Eigen::MatrixXd inverse_;  ///< inverse gram of the owned features
};

}  // namespace trunnion::diagnosis
