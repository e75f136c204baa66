// Laser, autocollimator, tracker and servo log beside a running program: the rows that they take.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "emulator/effect_model.h"
#include "emulator/reading_log.h"
#include "motion/motion.h"
#include "setup/setup.h"

namespace trunnion::emulator {

/// Told by words, of the program (`DPRNT[MEASURE*LINEAR*R1*X]`) or of the person who runs it:
///     LINEAR R1 X        a laser reads target R1 along X (Y, Z) of M
///     ANGLE R1 Z         an autocollimator reads the tool's turn about Z
///     POINT R1 TRACKER   an instrument reads R1, three rows; without a name: the only one, or none
///     AXIS X 250         a log of the axis, so many times a second (100)
///     OFF                all of them end
/// The first three read whenever the axes stand for a dwell (G4), as their software does; a log
/// reads along moves and dwells. Rows come without a value: `fill_readings` reads them.
class MeasureStation {
  public:
    /// `setup` must outlive the station.
    explicit MeasureStation(const setup::Setup& setup) : setup_(setup) {}

    /// Throws InputError for words that name no device, target, instrument, axis or direction.
    void obey(std::string_view words, double time_s);
    bool logs() const { return !logged_.empty(); }

    /// The axes stand at `row.commanded` from `row.time_s` on.
    void dwell(const records::Reading& row, double duration_s, ReadingLog& log);
    /// `row`: of the begin of the move.
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

/// Device rows without a value get what the observer reads on the whole table, as `predict` does,
/// with the noise of `device_noise`.
void fill_readings(const setup::Setup& setup, const EffectModels& effects, std::uint64_t seed,
                   records::ReadingTable& table);

}  // namespace trunnion::emulator
