// The ballbar between spindle and table: reads its length along the moves that carry it.
#pragma once

#include <string>
#include <vector>

#include "base/random.h"
#include "emulator/observer.h"
#include "emulator/reading_log.h"
#include "motion/motion.h"

namespace trunnion::emulator {

/// When it reads: between the lines `BALLBAR ON name` and `BALLBAR OFF` that the program prints to
/// its PC, or, when asked to (`automatic`), along every feed move that stays within the range of
/// the transducer from end to end. The rows of a pass are kept without values; when it ends they
/// are read as any table of readings is.
class BallbarStation {
  public:
    /// `setup` must outlive the station.
    BallbarStation(const setup::Setup& setup, std::uint64_t seed, bool automatic);

    void start(double time_s);
    /// Ends a pass, reads its rows. Safe when none runs.
    void stop(const Observer& observer, ReadingLog& log);
    bool commanded() const { return commanded_; }
    bool running() const { return !moves_.empty(); }
    /// A move may be read.
    bool listens() const { return setup_.ballbar && (commanded_ || automatic_); }
    /// From now on a reading every so many degrees of the swept angle.
    void sample_every(double degrees) { sample_deg_ = degrees; }

    /// Rows along the move, begun at `row`'s time. False when the bar does not read.
    bool record(const motion::AxisMove& move, const records::Reading& row, ReadingLog& log);
    std::vector<std::string> take_notes() { return std::move(notes_); }

  private:
    struct Place {
        std::size_t row;  ///< of the log, the first of a move
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
    double sample_deg_ = 0.0;      ///< above 0: instead of the setup's
    double angle_left_rad_ = 0.0;  ///< to the next sample, when sampling by angle
    int passes_ = 0;
    const setup::Artefact* pivot_ = nullptr;  ///< of the pass
    std::vector<Place> moves_;                ///< of the pass
    /// Of all pivots beyond the bar's range when the axes stood at `apart_at_`: until they have
    /// gone that far nobody need look again.
    double apart_mm_ = -1.0;
    AxisPositions apart_at_;
    std::vector<std::string> notes_;
};

}  // namespace trunnion::emulator
