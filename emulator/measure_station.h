// Rows of laser, autocollimator, tracker and servo log during a program.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/effect_model.h"
#include "emulator/reading_log.h"
#include "motion/motion.h"
#include "setup/setup.h"

namespace trunnion::emulator {

/// Commands, from the program (`DPRNT[MEASURE*LINEAR*R1*X]`) or from the user:
///     LINEAR R1 X        a laser reads target R1 along X (Y, Z) of M
///     ANGLE R1 Z         an autocollimator reads the rotation of the tool about Z
///     POINT R1 TRACKER   an instrument reads R1, three rows; without a name: the only one, or none
///     AXIS X 250         a servo log of the axis, samples a second (default 100)
///     OFF                ends all of them
/// The first three read whenever the axes are at rest for a dwell (G4), as their software does. A
/// log reads during moves and dwells. Rows have no value until `fill_readings` evaluates them.
class MeasureStation {
  public:
    /// `setup` must outlive the station.
    explicit MeasureStation(const setup::Setup& setup) : setup_(setup) {}

    /// Throws InputError for words that name no device, target, instrument, axis or direction.
    void obey(std::string_view words, double time_s);
    bool logs() const { return !logged_.empty(); }

    /// The axes are at rest at `row.commanded` from `row.time_s` on.
    void dwell(const records::Reading& row, double duration_s, ReadingLog& log);
    /// `row`: at the start of the move.
    void record(const motion::AxisMove& move, const records::Reading& row, ReadingLog& log);

  private:
    records::Reading target_row(records::Device device, std::string_view name) const;
    void add_displacement(records::Device device, const std::vector<std::string>& words);
    void add_point(const std::vector<std::string>& words);
    void add_axis(const std::vector<std::string>& words, double time_s);
    template <typename Place>
    void take_log(const records::Reading& row, double duration_s, const Place& place,
                  ReadingLog& log);

    const setup::Setup& setup_;
    std::vector<records::Reading> static_;  ///< device, feature, direction, instrument
    std::vector<records::Reading> logged_;
    double step_s_ = 0.01, next_s_ = 0.0;
};

/// Evaluates device rows without a value with the observer on the whole table, as in `predict`,
/// with the noise of `device_noise`.
void fill_readings(const setup::Setup& setup, const EffectModels& effects, std::uint64_t seed,
                   records::ReadingTable& table);

}  // namespace trunnion::emulator
