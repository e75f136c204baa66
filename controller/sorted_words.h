// The words of one block by letter, as all G code handlers read them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "controller/g_codes.h"
#include "geometry/axes.h"

namespace trunnion::controller {

/// Units of the words of this block: G20 or G21, 3401#0.
struct WordUnits {
    double unit_mm = 1.0;      ///< mm in one programmed unit: 1 or 25.4
    double bare_linear = 1.0;  ///< mm per unit of a word without decimal point
    double bare_rotary = 1.0;  ///< deg per unit of a word without decimal point
    bool inch() const { return unit_mm != 1.0; }
};

/// Values as written (no unit applied). Only letters whose bit is set in `present` have a value.
struct SortedWords {
    static constexpr std::uint32_t bit(char letter) { return 1U << (letter - 'A'); }
    /// The letters of axes, in the order of `Axis`.
    static constexpr std::uint32_t axis_letters = 0x7U | (0x3FU << 20);  // A B C, U V W X Y Z
    static constexpr std::uint32_t centre_letters = 0x7U << 8;           // I J K

    std::uint32_t present = 0;
    std::uint32_t bare = 0;  ///< integers without decimal point
    std::array<double, 26> value{};
    std::array<std::uint16_t, 26> column{};
    bool corner_radius = false;   ///< ,R
    bool corner_chamfer = false;  ///< ,C
    double corner = 0.0;
    /// Hurco: further Z words of a block, as written (depths of the pecks).
    std::array<double, 2> more_depths{};
    std::size_t more_depth_count = 0;

    static constexpr std::size_t max_codes = 16;
    std::array<const GCode*, max_codes> code{};  ///< all codes except group 01
    std::array<std::uint16_t, max_codes> code_column{};
    std::size_t code_count = 0;
    std::uint32_t phases = 0;         ///< one bit for each phase with a code
    const GCode* motion = nullptr;    ///< the last code of group 01 in this block
    std::uint16_t motion_column = 0;  ///< 0: not in this block
    static constexpr std::size_t max_m_codes = 12;
    std::array<int, max_m_codes> m{};
    std::array<std::uint16_t, max_m_codes> m_column{};
    std::size_t m_count = 0;
    std::uint16_t running_column = 0;  ///< column of the code being executed; 0: the axis words
    WordUnits units;

    bool has(char letter) const { return (present & bit(letter)) != 0; }
    double get(char letter) const { return value[static_cast<std::size_t>(letter - 'A')]; }
    double get(char letter, double otherwise) const {
        return has(letter) ? get(letter) : otherwise;
    }
    bool is_bare(char letter) const { return (bare & bit(letter)) != 0; }
    /// A dimension word (X I R Q ..) in mm.
    double length_mm(char letter) const {
        return get(letter) * (is_bare(letter) ? units.bare_linear : units.unit_mm);
    }
    /// An angle word in deg; also a component of a direction.
    double angle_deg(char letter) const {
        return get(letter) * (is_bare(letter) ? units.bare_rotary : 1.0);
    }
    /// An axis word in mm or deg.
    double axis_value(Axis axis) const;
    /// A word that must be an integer: H D P L T ...; PS0007 otherwise, PS0003 beyond 9 digits.
    int whole(char letter) const;
    bool has(Axis axis) const { return has(letter_of(axis)); }
    /// True when the code is one of those outside group 01.
    bool has_code(int code10) const;

    /// Column of a word; 0 when the block does not have it.
    int column_of(char letter) const {
        return has(letter) ? column[static_cast<std::size_t>(letter - 'A')] : 0;
    }
    /// Column of the leftmost word with one of these letters (bits as in `present`); 0: none.
    int column_of_first(std::uint32_t letters) const {
        int first = 0;
        for (std::size_t i = 0; i < column.size(); ++i)
            if ((present & letters & (1U << i)) && (first == 0 || column[i] < first))
                first = column[i];
        return first;
    }
    /// Column for an alarm that names no word: the code being executed, else the code of group 01,
    /// the axis words, or the first word.
    int column_at_fault() const {
        for (const int at :
             {int{running_column}, int{motion_column}, column_of_first(axis_letters)})
            if (at != 0) return at;
        if (code_count != 0) return code_column[0];
        return m_count != 0 ? m_column[0] : column_of_first(~0U);
    }
    bool has_axis() const { return (present & axis_letters) != 0; }

    void clear() {
        present = bare = phases = 0;
        code_count = m_count = 0;
        motion = nullptr;
        motion_column = running_column = 0;
        corner_radius = corner_chamfer = false;
        more_depth_count = 0;
    }
};

}  // namespace trunnion::controller
