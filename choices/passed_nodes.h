// Ends of moves between two samples: how far they are from the log, beyond what samples leave open.
#pragma once

#include <cstdint>
#include <vector>

#include "choices/pairing.h"
#include "choices/progress.h"
#include "choices/space.h"

namespace trunnion::choices {

/// Nodes of a path that are passed between two rows.
class PassedNodes {
  public:
    using ControlPosition = offsets::ControlPosition;

    PassedNodes(const LogView& log, const ControlPath& path)
        : log_(log), path_(path), space_(log.axes) {}
    /// Of a log of samples, before anything else is asked.
    void measure();
    const Strides& strides() const { return strides_; }

    /// Distance between a node and the chord from row i on, minus the distance of samples.
    ControlPosition missed(std::size_t i, std::size_t k, const Progress& motion) const;
    /// Between the start of a motion and the chord to its first row, minus the distance of its own
    /// samples: a short way without a sample ends where this motion begins.
    ControlPosition missed_before(const Progress& motion) const;

    struct Cost {
        double at_node;  ///< of the node
        double before;   ///< of the start of the motion that ends there, beyond what it cost so far
        double sum() const { return at_node + before; }
    };
    /// Of passing node k from row `from` on.
    Cost cost(std::size_t from, std::size_t k, const Progress& motion) const;
    Progress after(const Progress& motion, std::size_t k, const Cost& cost) const {
        return motion.after(k, path_.nodes[k].end, cost.at_node);
    }
    /// The row whose chord passes a node when i rows are placed: the last one, or the one before
    /// the next. Between two visits of a block they are not the same.
    std::size_t row_at(const std::vector<std::size_t>& rows, std::size_t i, std::size_t k,
                       const Progress& motion) const;

  private:
    ControlPosition off_chord(std::size_t i, std::size_t k) const;
    double allowed(std::size_t i, std::size_t k, const Progress& motion) const;
    ControlPosition shortened(ControlPosition apart, double by) const;

    const LogView& log_;
    const ControlPath& path_;
    Space space_;
    Strides strides_;
    std::vector<std::uint32_t> begin_;  ///< node where the motion to each node begins
    std::vector<double> length_;        ///< of the path from there to each node, mm or deg
};

}  // namespace trunnion::choices
