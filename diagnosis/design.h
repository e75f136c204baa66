// Whitened columns of all groups, set-up projected out, with the products that a search needs.
//
// Rows        whitened readings, then one row for each calibrated value of the set-up (a known
// value
//             is one more reading).
// Features    raw material of the groups: derivatives by single parameters, by knots of a table.
//             A group combines features linearly (ColumnGroup::shape), so that all correlation
//             lengths of a table share one set of knots.
// Products    of features with the data and within one group are worked out when they are added;
//             products of a member with all features when it first becomes a member.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "diagnosis/column_group.h"
#include "estimation/projection.h"
#include "estimation/variance_groups.h"

namespace trunnion::diagnosis {

class Design {
  public:
    /// `known` whitened set-up columns, `data` whitened residuals, `rows` how many count.
    Design(Eigen::MatrixXd known, Eigen::VectorXd data, double rows);

    /// Whitened features (fewer rows than the design: the rest is zero); returns the first's index.
    Eigen::Index add_features(const Eigen::MatrixXd& white);
    /// Groups whose features stand in the design; returns the index of the group.
    std::size_t add(ColumnGroup group);
    /// A group orthogonal to all features up to `owned` (those of the textbook effects).
    std::size_t add_beside(ColumnGroup group, Eigen::Index owned);
    /// Other data for the same columns (large effects bend the readings).
    void set_data(const Eigen::VectorXd& data);

    struct Entry {
        ColumnGroup group;
        Eigen::MatrixXd gram;     ///< of its columns, set-up projected out
        Eigen::VectorXd product;  ///< with the data
        double whole = 0.0;       ///< squared sum of its columns before the projection
        bool hidden = false;
        /// Set-up does not swallow it, and a usual change moves the readings.
        bool visible() const;
    };
    const std::vector<Entry>& groups() const { return groups_; }
    const ColumnGroup& group(std::size_t k) const { return groups_[k].group; }

    const Eigen::MatrixXd& known() const { return known_; }
    const Eigen::VectorXd& data() const { return data_; }
    const estimation::Projection& projection() const { return projection_; }
    double rows() const { return rows_; }
    double freedom() const { return rows_ - static_cast<double>(projection_.rank()); }
    /// Whitened columns of a group, set-up not projected out: rows x columns.
    Eigen::MatrixXd columns(std::size_t group) const;

    estimation::GroupEquations equations(const std::vector<std::size_t>& members);
    /// Products of the members' columns with those of another group.
    Eigen::MatrixXd cross(const std::vector<std::size_t>& members, std::size_t group);
    /// Features as they are, whatever groups make of them: information and product with the data.
    estimation::GroupInformation of(const std::vector<Eigen::Index>& features) const {
        return {gram_of(features, features), product_of(features)};
    }
    /// The group is offered no longer.
    void hide(std::size_t group) { groups_[group].hidden = true; }
    /// Part of a group's squared columns that some features cannot follow.
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
        Eigen::VectorXd whole;  ///< squared length of each feature, set-up not projected out
    };
    const Block& block_of(Eigen::Index feature) const;
    Eigen::Map<const Eigen::MatrixXd> gathered(const std::vector<Eigen::Index>& list,
                                               Eigen::MatrixXd Block::*part,
                                               Eigen::MatrixXd& storage) const;
    const Products& of_features(const std::vector<Eigen::Index>& features);
    const Eigen::MatrixXd& products(std::size_t member);
    Eigen::VectorXd product_of(const std::vector<Eigen::Index>& features) const;
    Eigen::MatrixXd gram_of(const std::vector<Eigen::Index>& a,
                            const std::vector<Eigen::Index>& b) const;
    const Eigen::MatrixXd& owned_inverse(Eigen::Index owned) const;

    Eigen::MatrixXd known_;
    Eigen::VectorXd data_;
    double rows_;
    estimation::Projection projection_;
    Eigen::VectorXd data_coordinates_;
    Eigen::Index features_ = 0;
    std::vector<Block> blocks_;
    std::vector<Entry> groups_;
    Products last_;
    std::map<std::size_t, Eigen::MatrixXd> products_;  ///< features x columns, of members
    mutable Eigen::MatrixXd inverse_;                  ///< of the owned features' gram
};

}  // namespace trunnion::diagnosis
