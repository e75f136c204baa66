// The page of a run: machine, tool path with the deviation of the physical tip, blocks, time.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "emulator/run.h"
#include "report/page.h"

namespace trunnion::report {

/// The path of a run from its trace (CSV with --truth), in pieces of whole lines. At most `most`
/// points are kept: beyond that every second one is dropped, repeatedly.
class RunPath {
  public:
    static constexpr std::size_t most = 200'000;

    /// One row of the trace.
    struct Point {
        std::vector<double> axes;  ///< mm and deg, in the order of the trace
        std::array<double, 3> tip_W_mm{}, true_tip_W_mm{};  ///< believed and physical
        double time_s = 0.0;
        int program = 0;    ///< index in `programs`
        bool feed = false;  ///< part of a move with feed
        int line = 0, tool = 0;
    };

    void add(std::string_view chunk);

    const std::vector<Point>& points() const { return points_; }
    const std::vector<std::string>& programs() const { return programs_; }
    const std::vector<std::string>& axis_columns() const { return axis_columns_; }
    int stride() const { return stride_; }  ///< 1: every point is kept
    /// Number of trace rows so far.
    std::size_t rows() const { return rows_; }

  private:
    void take_header(std::string_view line);
    void take_row(std::string_view line);
    void close_move(bool feed);
    void thin();
    int program_index(const std::string& name);

    std::string rest_;
    std::map<std::string, std::size_t, std::less<>> column_;
    std::vector<std::string> axis_columns_, programs_;
    std::vector<Point> points_;
    std::size_t open_ = 0;  ///< first point of the move that is still open
    std::size_t rows_ = 0;
    int stride_ = 1;
};

/// Text of each program by its name in the trace; without text no blocks are shown.
using ProgramTexts = std::map<std::string, std::string>;

/// Title, verdict (alarm, limit or the largest deviation with its block), view and figures.
Page run_page(const setup::Setup& setup, const emulator::RunLog& log, const RunPath& path,
              const ProgramTexts& programs);

}  // namespace trunnion::report
