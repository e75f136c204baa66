// The words of one block by letter: what every G code handler reads.
#pragma once

#include <array>
#include <cstdint>

namespace trunnion {

struct GCode;

/// Values as written (no unit applied). Only letters whose bit is set in `present` hold a value.
struct SortedWords {
    static constexpr std::uint32_t bit(char letter) { return 1U << (letter - 'A'); }
    /// The letters of axes, in the order of `Axis`.
    static constexpr std::uint32_t axis_letters = 0x7U | (0x3FU << 20);  // A B C, U V W X Y Z

    std::uint32_t present = 0;
    std::uint32_t bare = 0;  ///< written as an integer without a decimal point
    std::array<double, 26> value{};
    std::array<std::uint16_t, 26> column{};
    bool corner_radius = false;   ///< ,R
    bool corner_chamfer = false;  ///< ,C
    double corner = 0.0;

    static constexpr std::size_t max_codes = 12;
    std::array<const GCode*, max_codes> code{};  ///< all but group 01
    std::size_t code_count = 0;
    std::uint32_t phases = 0;       ///< one bit for each phase that has a code
    const GCode* motion = nullptr;  ///< the last code of group 01 in this block
    std::array<int, max_codes> m{};
    std::size_t m_count = 0;
    int line = 0;
    std::uint64_t byte = 0;

    bool has(char letter) const { return (present & bit(letter)) != 0; }
    double get(char letter) const { return value[static_cast<std::size_t>(letter - 'A')]; }
    double get(char letter, double otherwise) const {
        return has(letter) ? get(letter) : otherwise;
    }
    bool is_bare(char letter) const { return (bare & bit(letter)) != 0; }
    int column_of(char letter) const { return column[static_cast<std::size_t>(letter - 'A')]; }
    bool has_axis() const { return (present & axis_letters) != 0; }

    void clear() {
        present = bare = phases = 0;
        code_count = m_count = 0;
        motion = nullptr;
        corner_radius = corner_chamfer = false;
    }
};

}  // namespace trunnion
