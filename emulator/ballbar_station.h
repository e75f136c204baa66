// The ballbar between spindle and table: reads its length along the moves that carry it.
#pragma once

#include <string>
#include <vector>

#include "base/random.h"
#include "emulator/observer.h"
#include "emulator/reading_log.h"
#include "motion/motion.h"

namespace trunnion::emulator {

/// It reads between the lines `BALLBAR ON name` and `BALLBAR OFF` that the program prints to its PC
/// or, with `automatic`, along every feed move that stays within the range of the transducer. The
/// rows of a pass are stored without values; at the end of the pass they are evaluated like any
/// table of readings.
class BallbarStation {
  public:
    /// `setup` must outlive the station.
    BallbarStation(const setup::Setup& setup, std::uint64_t seed, bool automatic);

    void start(double time_s);
    /// Ends a pass and evaluates its rows. No effect when no pass is active.
    void stop(const Observer& observer, ReadingLog& log);
    bool commanded() const { return commanded_; }
    bool running() const { return !moves_.empty(); }
    /// True when a move may be read.
    bool listens() const { return setup_.ballbar && (commanded_ || automatic_); }
    /// From now on one reading every `degrees` of the swept angle.
    void sample_every(double degrees) { sample_deg_ = degrees; }

    /// Adds rows along the move, starting at the time of `row`. False when the bar does not read.
    bool record(const motion::AxisMove& move, const records::Reading& row, ReadingLog& log);
    std::vector<std::string> take_notes() { return std::move(notes_); }

  private:
    struct Place {
        std::size_t row;  ///< index in the log of the first row of the move
        std::string text;
    };
    double nominal_mm(const motion::AxisMove& move, double s, const setup::Artefact& pivot,
                      const records::Reading& row) const;
    bool stays_in_range(const motion::AxisMove& move, const setup::Artefact& pivot,
                        const records::Reading& row);
    void choose_pivot(const motion::AxisMove& move, const records::Reading& row);
    std::vector<double> places(const motion::AxisMove& move, double time_s);
    void read_pass(const Observer& observer, ReadingLog& log, const std::vector<double>& noise_mm);
    void note_out_of_range(std::size_t row, double value_mm, const std::string& test);

    const setup::Setup& setup_;
    kinematics::ForwardModel nominal_;
    SeededNoise noise_;
    bool automatic_ = false, commanded_ = false;
    double start_s_ = 0.0;
    double sample_deg_ = 0.0;      ///< > 0: replaces the spacing of the setup
    double angle_left_rad_ = 0.0;  ///< angle to the next sample, when sampling by angle
    int passes_ = 0;
    const setup::Artefact* pivot_ = nullptr;  ///< of the current pass
    std::vector<Place> moves_;                ///< of the current pass
    /// Smallest distance (mm) of a pivot beyond the bar's range when the axes were at `apart_at_`:
    /// no check is needed until they have moved that far.
    double apart_mm_ = -1.0;
    AxisPositions apart_at_;
    std::vector<std::string> notes_;
};

}  // namespace trunnion::emulator
