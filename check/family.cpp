// Programs for a lathe or a Haas, recognised by words that a mill's program does not have.
#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <limits>

#include "check/section.h"

namespace trunnion::check {

namespace {

struct Code {
    char letter;
    int code10;
};

/// One block as the signs look at it; macro calls and blocks of a called code have no words.
class Words {
  public:
    Words(const interpreter::ParsedProgram& program, const interpreter::Block* block,
          const CheckOptions& options)
        : program_(&program) {
        if (!block || block->kind == interpreter::BlockKind::statements ||
            passes_arguments(program, *block, options))
            return;
        block_ = block;
        for (const interpreter::Item& item : program.items(*block)) {
            if (item.kind != interpreter::ItemKind::word || item.letter < 'A' || item.letter > 'Z')
                continue;
            present_.set(static_cast<std::size_t>(item.letter - 'A'));
            const auto value = interpreter::constant_value(program, item);
            if (value && (item.letter == 'G' || item.letter == 'M'))
                codes_.push_back({item.letter, code10_of(*value)});
        }
    }

    bool has(char letter) const { return present_.test(static_cast<std::size_t>(letter - 'A')); }
    bool has_all(std::string_view letters) const {
        return std::all_of(letters.begin(), letters.end(), [&](char c) { return has(c); });
    }
    bool has_any(std::string_view letters) const {
        return std::any_of(letters.begin(), letters.end(), [&](char c) { return has(c); });
    }
    /// True when the block has no other words.
    bool only(std::string_view letters) const {
        auto rest = present_;
        for (const char c : letters) rest.reset(static_cast<std::size_t>(c - 'A'));
        return rest.none();
    }
    const std::vector<Code>& codes() const { return codes_; }
    bool code(char letter, int code10) const {
        return std::any_of(codes_.begin(), codes_.end(),
                           [&](const Code& c) { return c.letter == letter && c.code10 == code10; });
    }
    bool g(int code10) const { return code('G', code10); }
    double value(char letter) const {
        return block_ ? word_value(*program_, *block_, letter).value_or(-1.0) : -1.0;
    }
    bool has_comment() const { return block_ && block_->comments.count > 0; }
    bool has_one_g() const {
        return std::count_if(codes_.begin(), codes_.end(),
                             [](const Code& c) { return c.letter == 'G'; }) == 1;
    }
    /// The digits of a word without a point as written: "0303" of T0303; empty for other words.
    std::string_view digits(char letter) const {
        if (!block_) return {};
        for (const interpreter::Item& item : program_->items(*block_)) {
            if (item.kind != interpreter::ItemKind::word || item.letter != letter) continue;
            if (item.decimal_point || item.a.count > 0 || item.column == 0) return {};
            const std::string_view text = program_->text(*block_).substr(item.column);
            const std::size_t first = text.find_first_not_of(' ');
            if (first == text.npos) return {};
            return text.substr(first, text.find_first_not_of("0123456789", first) - first);
        }
        return {};
    }

  private:
    const interpreter::ParsedProgram* program_;
    const interpreter::Block* block_ = nullptr;
    std::bitset<26> present_;
    std::vector<Code> codes_;
};

/// A block, the one behind it, and its program.
struct Place {
    const Words &block, &next;
    const CheckSection& section;
    const CheckOptions& options;
};

constexpr bool (*const any)(const Place&) = [](const Place&) { return true; };

/// P and Q of G70 to G73 are sequence numbers: whole, and no position stands in the block.
bool names_contour(const Place& p) {
    return !p.block.digits('P').empty() && !p.block.digits('Q').empty() && !p.block.has_any("XYZR");
}

bool is_pattern_repeat(const Place& p) {
    return names_contour(p) && p.block.has_all("UW");
}

bool is_head_of_roughing(const Place& p) {
    return p.block.has('R') && (p.block.only("GUR") || p.block.only("GWR"));
}

bool is_threading_pair(const Place& p) {
    return p.block.digits('P').size() == 6 && !p.block.has_any("XYZUW") && p.next.g(760) &&
           p.next.has_any("XU") && p.next.has_any("ZW") && p.next.has_all("PQ") && !p.next.has('Y');
}

bool is_old_threading(const Place& p) {
    return p.block.has_any("XU") && p.block.has_any("ZW") && p.block.has_all("KD") &&
           !p.block.has_any("YQR");
}

/// `G75 R1.` and the cycle in the next block, whose P or Q are thousandths.
bool is_grooving_pair(const Place& p, int code10) {
    return p.block.has('R') && p.block.only("GR") && p.next.g(code10) && !p.next.has_any("YR") &&
           p.next.has_any("XZUW") &&
           std::max(p.next.digits('P').size(), p.next.digits('Q').size()) >= 3;
}

bool is_thread_pass(const Place& p) {
    return p.block.has_any("XU") && p.block.has_any("ZW") && p.block.has('F') &&
           !p.block.has('Y') && p.block.has_one_g();
}

bool is_thread_cut(const Place& p) {
    return p.block.has_any("XUZW") && p.block.has('F') && !p.block.has('Y');
}

bool is_speed_limit(const Place& p) {
    return p.block.has('S') && p.block.only("GSXZTM") && p.block.has_one_g() &&
           !p.block.code('M', 30) && !p.block.code('M', 40);
}

/// T0303 or T0300: tool and offset in one word.
bool is_tool_with_offset(const Place& p) {
    const std::string_view t = p.block.digits('T');
    return t.size() == 4 && t.substr(0, 2) != "00" &&
           (t.substr(2) == t.substr(0, 2) || t.substr(2) == "00");
}

/// U as an axis word of a machine without U: an increment of X.
bool is_increment(const Place& p) {
    return p.block.has('U') && !p.block.has_any("PQY") && !p.options.has_u_axis;
}

bool calls_own_sequence(const Place& p) {
    const double p_word = p.block.value('P');
    return p.section.numbered.contains(whole_of(p_word));
}

struct Sign {
    const char* family;
    int points;  ///< 2 shows the family, two different signs of 1 do so together
    char letter;
    int first10, last10;          ///< the code, or a range of codes; 0 and -1: any block
    bool (*shows)(const Place&);  ///< what the block has besides the code
    const char* text;
    bool with_other_words = false;  ///< our controls have the code, with other words
};

// Fanuc's G-code system A for lathes, and Haas mills: assumed, from programs that were read. No
// manual of either was at hand.
const Sign signs[] = {
    {"lathe", 2, 'G', 710, 710, names_contour, "G71 P Q", true},
    {"lathe", 2, 'G', 720, 720, names_contour, "G72 P Q", true},
    {"lathe", 2, 'G', 700, 700, names_contour, "G70 P Q", true},
    {"lathe", 2, 'G', 730, 730, is_pattern_repeat, "G73 P Q U W", true},
    {"lathe", 2, 'G', 710, 710, is_head_of_roughing, "G71 U R", true},
    {"lathe", 2, 'G', 720, 720, is_head_of_roughing, "G72 W R", true},
    {"lathe", 2, 'G', 760, 760, is_threading_pair, "G76 P Q R, G76 X Z P Q", true},
    {"lathe", 1, 'G', 760, 760, is_old_threading, "G76 X Z K D", true},
    {"lathe", 1, 'G', 740, 740, [](const Place& p) { return is_grooving_pair(p, 740); },
     "G74 R, G74 Z Q", true},
    {"lathe", 2, 'G', 750, 750, [](const Place& p) { return is_grooving_pair(p, 750); },
     "G75 R, G75 X P", true},
    {"lathe", 1, 'G', 920, 920, is_thread_pass, "G92 X Z F", true},
    {"lathe", 1, 'G', 320, 320, is_thread_cut, "G32 Z F"},
    {"lathe", 1, 'G', 500, 500, is_speed_limit, "G50 S", true},
    {"lathe", 1, 'G', 960, 960, [](const Place& p) { return p.block.has('S'); }, "G96 S", true},
    {"lathe", 1, 'T', 0, -1, is_tool_with_offset, "T", true},
    {"lathe", 1, 'U', 0, -1, is_increment, "U without a U axis", true},
    {"Haas", 2, 'M', 970, 970, calls_own_sequence, "M97 P"},
    {"Haas", 1, 'M', 970, 970, [](const Place& p) { return p.block.has('P'); }, "M97 P"},
    {"Haas", 2, 'G', 1870, 1870,
     [](const Place& p) {
         return p.block.only("GPE") && (!p.block.has('P') || p.block.value('P') <= 3.0);
     },
     "G187"},
    {"Haas", 2, 'G', 1540, 1540, [](const Place& p) { return p.block.has('P'); }, "G154 P"},
    {"Haas", 2, 'G', 1030, 1030,
     [](const Place& p) { return p.block.has('P') && p.block.only("GP"); }, "G103 P"},
    {"Haas", 2, 'G', 1500, 1500,
     [](const Place& p) { return p.block.has_all("PZ") && p.block.has_any("IJ"); }, "G150 P Z I",
     true},
    {"Haas", 1, 'M', 1300, 1300, any, "M130"},
    {"Haas", 1, 'G', 120, 130, [](const Place& p) { return p.block.has('I'); }, "G12, G13 I"},
    {"Haas", 1, 'G', 470, 470,
     [](const Place& p) { return p.block.has('P') && p.block.has_comment() && !p.block.has('D'); },
     "G47 P (text)", true},
    {"Haas", 1, 'G', 700, 720,
     [](const Place& p) { return p.block.has_all("IL") && !p.block.has_any("PQ"); },
     "G70 to G72 I L", true},
    {"Haas", 1, 'G', 1100, 1290, [](const Place& p) { return p.block.only("GXYZABCFSTMHD"); },
     "G110 to G129"},
    {"Haas", 1, 'G', 1430, 1430, [](const Place& p) { return p.block.has('H'); }, "G143 H"},
    {"Haas", 1, 'G', 2340, 2340, [](const Place& p) { return p.block.has('H'); }, "G234 H"},
    {"Haas", 1, 'G', 2540, 2550, any, "G254, G255"},
};

/// This control has the code, by its dialect or by its builder's profile.
bool is_own(const Sign& sign, int code10, const CheckOptions& options) {
    if (sign.letter != 'G' && sign.letter != 'M') return false;
    if (options.builders_code && options.builders_code(sign.letter, code10)) return true;
    return sign.letter == 'G' && !sign.with_other_words && options.knows_g &&
           options.knows_g(code10);
}

bool has_code_of(const Sign& sign, const Place& place) {
    const auto& codes = place.block.codes();
    return sign.last10 < sign.first10 || std::any_of(codes.begin(), codes.end(), [&](Code c) {
               return c.letter == sign.letter && c.code10 >= sign.first10 &&
                      c.code10 <= sign.last10 && !is_own(sign, c.code10, place.options);
           });
}

struct SeenSign {
    const Sign* sign;
    const interpreter::Block* block;
    std::string digits;  ///< of T
};

/// The signs of a program, each at its first block.
std::vector<SeenSign> signs_of(const CheckSection& section, const CheckOptions& options) {
    std::vector<SeenSign> seen;
    const auto known = [&](const Sign& sign) {
        return std::any_of(seen.begin(), seen.end(), [&](const SeenSign& s) {
            return s.sign->text == std::string_view(sign.text);
        });
    };
    const std::size_t count = section.blocks.size();
    Words block(*section.program, count ? section.blocks[0] : nullptr, options);
    for (std::size_t i = 0; i < count; ++i) {
        Words next(*section.program, i + 1 < count ? section.blocks[i + 1] : nullptr, options);
        const Place place{block, next, section, options};
        for (const Sign& sign : signs)
            if (has_code_of(sign, place) && sign.shows(place) && !known(sign))
                seen.push_back({&sign, section.blocks[i], std::string(block.digits(sign.letter))});
        block = std::move(next);
    }
    return seen;
}

/// The points that call a program a lathe's without a certain sign; none are enough beside a word
/// of mills (Y, G43, G17). Some lathes have M6.
int points_of_lathe(const CheckSection& section, const CheckOptions& options) {
    int points = 2;
    for (const interpreter::Block* block : section.blocks) {
        const Words words(*section.program, block, options);
        if (words.has('Y') || words.g(430) || words.g(434) || words.g(170))
            return std::numeric_limits<int>::max();
        if (words.code('M', 60)) points = 3;
    }
    return points;
}

std::string what_shows(const std::vector<SeenSign>& seen, const char* family) {
    std::string text;
    std::size_t count = 0;
    for (const SeenSign& s : seen)
        if (s.sign->family == std::string_view(family) && ++count <= 3)
            text += fmt::format("{}{}{} in line {}", text.empty() ? "" : "; ", s.sign->text,
                                s.sign->letter == 'T' ? s.digits : "", s.block->line);
    return text;
}

}  // namespace

bool check_family(const CheckSection& section, const CheckOptions& options, Findings& findings) {
    const std::vector<SeenSign> seen = signs_of(section, options);
    for (const char* const family : {"lathe", "Haas"}) {
        int points = 0;
        bool certain = false;
        const interpreter::Block* first = nullptr;
        for (const SeenSign& s : seen) {
            if (s.sign->family != std::string_view(family)) continue;
            points += s.sign->points;
            certain = certain || s.sign->points == 2;
            if (!first) first = s.block;
        }
        const bool lathe = family == std::string_view("lathe");
        if (points < 2) continue;
        if (!certain && lathe && points < points_of_lathe(section, options)) continue;
        const int number = section.blocks.front()->o_number;
        findings.add("family", Severity::error, {*first, 1},
                     fmt::format("{} is a program for a {} ({}): it is not checked further",
                                 number > 0 ? fmt::format("O{:04}", number) : "this", family,
                                 what_shows(seen, family)),
                     "Run it on its own control; this one is a Fanuc or Hurco mill.");
        return true;
    }
    return false;
}

// Assumed, as the signs above.
const char* haas_meaning(int code10) {
    struct Meaning {
        int first10, last10;
        const char* text;
    };
    static constexpr Meaning meanings[] = {
        {120, 130, "circular pocket"},   {700, 720, "bolt holes"},
        {1000, 1010, "mirror image"},    {1030, 1030, "look-ahead limit"},
        {1100, 1290, "work offset"},     {1360, 1360, "probing"},
        {1410, 1410, "3D compensation"}, {1430, 1430, "five-axis tool length"},
        {1500, 1500, "pocket"},          {1530, 1530, "five-axis drilling"},
        {1540, 1540, "work offset"},     {1870, 1870, "accuracy"},
        {2340, 2340, "tool centre"},     {2540, 2550, "work offset of the rotary axes"}};
    for (const Meaning& m : meanings)
        if (code10 >= m.first10 && code10 <= m.last10 && code10 % 10 == 0) return m.text;
    return nullptr;
}

}  // namespace trunnion::check
