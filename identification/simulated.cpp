#include "identification/simulated.h"

#include "base/random.h"
#include "effects/settings.h"
#include "identification/base_model.h"

namespace trunnion::identification {

records::ReadingTable simulated(const setup::Setup& setup, const records::ReadingTable& table,
                                std::uint64_t seed) {
    records::ReadingTable read = emulator::predicted(setup, table, effects::active_models(setup));
    const emulator::Replay replay(setup, read);
    const RowNoise noise = stated_noise(setup, read, replay);
    SeededNoise source(seed);
    for (std::size_t i = 0; i < replay.size(); ++i)
        *read.rows[replay.table_row(i)].value_mm +=
            noise.sigma_mm(static_cast<Eigen::Index>(i)) * source.normal();
    read.comment["source"] = "simulated";
    read.comment["seed"] = std::to_string(seed);
    return read;
}

}  // namespace trunnion::identification
