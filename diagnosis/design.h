// Whitened columns of all groups, set-up projected out, with the products required by a search.
//
// Rows        whitened readings, then one row for each calibrated value of the set-up (a known
// value
//             is one more reading).
// Features    derivatives by single parameters, or by knots of a table. A group combines features
//             linearly (ColumnGroup::shape), so that all correlation lengths of a table share one
//             set of knots.
// Products    of features with the data, and within one group, are computed when they are added;
//             products of a member with the columns of all groups when it first becomes a member.
//             Search and solution then use only these small matrices.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "diagnosis/column_group.h"
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

    struct Entry {
        ColumnGroup group;
        Eigen::MatrixXd gram;     ///< of its columns, set-up projected out
        Eigen::VectorXd product;  ///< with the data
        double whole = 0.0;       ///< squared sum of its columns before projection
        bool hidden = false;
        bool only_rival = false;  ///< hidden, but may be named as a rival of a claim
        Eigen::Index first = 0;   ///< index of its first column among those of all groups
        std::optional<estimation::ReducedGroup> reduced;  ///< of its gram
        /// True when a typical change moves the readings noticeably and the set-up cannot absorb
        /// it.
        bool visible() const;
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
    /// set-up must not lack what both of them can do.
    Eigen::MatrixXd columns(std::size_t group) const;
    /// These columns times coefficients.
    Eigen::VectorXd combined(std::size_t group, const Eigen::VectorXd& coefficients) const;

    estimation::GroupEquations equations(const std::vector<std::size_t>& members);
    /// Products of the members' columns with those of other groups, side by side in their order.
    Eigen::MatrixXd cross(const std::vector<std::size_t>& members,
                          const std::vector<std::size_t>& groups);
    /// Products of all groups' columns (Entry::first) with the residual of the data after members
    /// with these coefficients.
    Eigen::VectorXd left(const std::vector<std::size_t>& members,
                         const Eigen::VectorXd& coefficients);
    /// Products of set-up (first) and members, without projection, with each other and with the
    /// data.
    struct Normal {
        Eigen::MatrixXd gram;
        Eigen::VectorXd product;
    };
    Normal normal(const std::vector<std::size_t>& members);
    /// Information and product with the data of single features, independent of groups.
    estimation::GroupInformation of(const std::vector<Eigen::Index>& features) const {
        return {gram_of(features, features), product_of(features)};
    }
    /// Excludes the group from further offers.
    void hide(std::size_t group) { groups_[group].hidden = true; }
    void offer_again(std::size_t group) { groups_[group].hidden = false; }
    /// The same as hide(), but it may be named as a rival.
    void keep_as_rival(std::size_t group) {
        groups_[group].hidden = groups_[group].only_rival = true;
    }
    /// Fraction of a group's squared columns outside the span of some features.
    double outside(std::size_t group, const std::vector<Eigen::Index>& features) const;

  private:
    struct Block {
        Eigen::Index first = 0;
        Eigen::MatrixXd white, coordinates;
        Eigen::VectorXd product;
    };
    struct Products {
        std::vector<Eigen::Index> features;
        Eigen::MatrixXd gram;
        Eigen::VectorXd whole;  ///< squared length of each feature, without projection
    };
    const Block& block_of(Eigen::Index feature) const;
    Eigen::Map<const Eigen::MatrixXd> gathered(const std::vector<Eigen::Index>& list,
                                               Eigen::MatrixXd Block::*part,
                                               Eigen::MatrixXd& storage) const;
    const Products& of_features(const std::vector<Eigen::Index>& features);
    std::size_t append(Entry entry);
    const Eigen::MatrixXd& products(std::size_t member);
    const Eigen::MatrixXd& coordinates(std::size_t member);
    Eigen::VectorXd product_of(const std::vector<Eigen::Index>& features) const;
    Eigen::MatrixXd gram_of(const std::vector<Eigen::Index>& a,
                            const std::vector<Eigen::Index>& b) const;
    const Eigen::MatrixXd& owned_inverse(Eigen::Index owned) const;

    Eigen::MatrixXd known_;
    Eigen::VectorXd data_;
    double rows_;
    estimation::Projection projection_;
    Eigen::VectorXd data_coordinates_;
    Eigen::MatrixXd known_coordinates_;
    Eigen::Index features_ = 0, columns_ = 0;
    Eigen::VectorXd products_;  ///< of all groups' columns with the data
    std::vector<Block> blocks_;
    std::vector<Entry> groups_;
    Products last_;
    /// For each member: its products with the columns of all groups seen so far, and its component
    /// within the set-up.
    struct Seen {
        Eigen::MatrixXd products;
        std::size_t groups = 0;
        Eigen::MatrixXd coordinates;
    };
    std::map<std::size_t, Seen> seen_;
    mutable Eigen::MatrixXd inverse_;  ///< inverse gram of the owned features
};

}  // namespace trunnion::diagnosis
