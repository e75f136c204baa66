// The ballbar between spindle and table: reads its length along the moves that carry it.
#pragma once

#include <string>
#include <vector>

#include "ballbar/ballbar.h"
#include "emulator/path_sampler.h"
#include "emulator/physical_machine.h"
#include "emulator/reading_log.h"
#include "setup/setup.h"
#include "base/random.h"

namespace trunnion {

/// When it reads: between the lines `BALLBAR ON name` and `BALLBAR OFF` that the program prints to
/// its PC; in a program that prints no such line, along every feed move that stays within the range
/// of the transducer from end to end.
class BallbarStation {
  public:
    /// `setup` must outlive the station.
    BallbarStation(const Setup& setup, std::uint64_t seed);

    void start(double time_s);
    void stop();
    bool commanded() const { return commanded_; }
    /// From now on a reading every so many degrees of the swept angle.
    void sample_every(double degrees) { sample_deg_ = degrees; }

    /// Readings along the move, appended to the log. False when the bar did not read.
    bool record(const PathSampler& path, const PhysicalMachine& machine, ReadingLog& log,
                AxisTracker& tracker);
    std::vector<std::string> take_notes() { return std::move(notes_); }

  private:
    const Artefact* mounted_pivot(const PathSampler& path, const PhysicalMachine& machine);
    std::vector<double> places(const PathSampler& path);
    void read(PathSampler path, double s, const PhysicalMachine& machine, ReadingLog& log);
    double deviation_mm(const PathSampler& path, double s, const PhysicalMachine& machine,
                        Contact contact, Contact* filled) const;

    const Setup& setup_;
    SeededNoise noise_;
    bool commanded_ = false, ever_commanded_ = false, running_ = false, out_of_range_ = false;
    double start_s_ = 0.0;
    double sample_deg_ = 0.0;      ///< above 0: instead of the setup's
    double angle_left_rad_ = 0.0;  ///< to the next sample, when sampling by angle
    int passes_ = 0;
    const Artefact* pivot_ = nullptr;
    /// Of all pivots beyond the bar's range when the axes stood at `apart_at_`: until they have
    /// gone that far nobody need look again.
    double apart_mm_ = -1.0;
    AxisPositions apart_at_;
    std::vector<std::string> notes_;
};

}  // namespace trunnion
