// A plain reading of simple NC programs, written for the mutation check alone: it shares nothing
// with the control. What it cannot judge for sure it says so.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace trunnion::testing {

/// One move as many points, with what the path layer compares beside it.
struct PlainMove {
    bool rapid = true;
    double feed = 0.0, spindle = 0.0;
    int tool = 0;
    bool coolant = false;
    std::vector<std::array<double, 3>> tips_mm;
};

/// What a block does besides moving: M and T codes as written, dwells ('D') in seconds.
struct PlainFunction {
    char kind = 'M';
    double value = 0.0;
    std::size_t moves_before = 0;
};

/// G0-G3, G4, G17, G20/G21, G40, G43 H Z, G49, G54, G55, G80-G82, G90/G91, G94, G98/G99 and plain M
/// codes on a three-axis machine.
class PlainInterpreter {
  public:
    PlainInterpreter(std::array<double, 3> g54_mm, std::map<int, double> length_mm,
                     std::array<double, 3> g55_mm = {})
        : g54_(g54_mm), first_(g54_mm), second_(g55_mm), length_of_(std::move(length_mm)) {}

    bool unsure = false;   ///< met something outside its subset
    bool stopped = false;  ///< a fault that stops a control
    std::vector<PlainMove> moves;
    std::vector<PlainFunction> functions;

    void run(const std::string& program) {
        std::size_t at = 0;
        while (at < program.size() && !done_ && !unsure && !stopped) {
            const std::size_t end = std::min(program.find('\n', at), program.size());
            block(program.substr(at, end - at));
            at = end + 1;
        }
    }

  private:
    using Words = std::vector<std::pair<char, double>>;

    void block(const std::string& line) {
        if (line.empty() || line[0] == '%' || line[0] == 'O') return;
        Words words;
        for (std::size_t at = 0; at < line.size();) {
            if (line[at] == ' ') {
                ++at;
                continue;
            }
            const char letter = line[at++];
            std::size_t used = 0;
            try {
                const std::string rest = line.substr(at);
                // Two letters in a row, an E, blanks between sign and digits: not for this reader.
                if (rest.empty() || std::string("+-.0123456789").find(rest[0]) == std::string::npos)
                    return void(unsure = true);
                words.emplace_back(letter, std::stod(rest, &used));
                const std::string number = rest.substr(0, used);
                if (std::string("XYZIJRF").find(letter) != std::string::npos &&
                    number.find('.') == std::string::npos)
                    return void(unsure = true);
            } catch (const std::exception&) {
                return void(unsure = true);
            }
            at += used;
        }
        obey(words);
    }

    static std::optional<double> find(const Words& words, char letter) {
        std::optional<double> value;
        for (const auto& [l, v] : words)
            if (l == letter) value = v;
        return value;
    }

    void obey(const Words& words) {
        int motion_codes = 0;
        bool length_code = false, dwells = false;
        for (const auto& [letter, value] : words) {
            int same = 0;
            for (const auto& [l, v] : words) same += l == letter;
            if (letter != 'G' && same > 1) return void(unsure = true);
            if (letter != 'G') continue;
            switch (static_cast<int>(std::lround(value * 10))) {
                case 0:
                case 10:
                case 20:
                case 30:
                    motion_ = static_cast<int>(value);
                    cycle_ = false;
                    ++motion_codes;
                    break;
                case 40: dwells = true; break;
                case 810:
                case 820:
                    drill_dwells_ = std::lround(value) == 82;
                    if (!cycle_) initial_z_ = program_z();
                    cycle_ = true;
                    ++motion_codes;
                    break;
                case 800:
                    cycle_ = false;
                    motion_ = motion_ > 1 ? 9 : motion_;
                    ++motion_codes;
                    break;
                case 200: inch_ = true; break;
                case 210: inch_ = false; break;
                case 900: incremental_ = false; break;
                case 910: incremental_ = true; break;
                case 980: to_initial_ = true; break;
                case 990: to_initial_ = false; break;
                case 430: length_code = true; break;
                case 540:
                case 550:
                    if (cycle_) return void(unsure = true);
                    g54_ = std::lround(value) == 54 ? first_ : second_;
                    break;
                case 170:
                case 400:
                case 940: break;
                case 490:
                    if (length_ != 0.0) return void(unsure = true);
                    break;
                default: return void(unsure = true);
            }
        }
        if (motion_codes > 1) return void(unsure = true);
        if (const auto s = find(words, 'S')) speed_ = *s;
        if (const auto t = find(words, 'T')) {
            chosen_ = static_cast<int>(*t);
            note('T', *t);
        }
        if (dwells) return dwell(words);
        if (const auto f = find(words, 'F')) feed_ = *f * unit();
        const auto m = find(words, 'M');
        if (m && words.size() > 1 && (*m == 0 || *m == 1) &&
            (find(words, 'X') || find(words, 'Y') || find(words, 'Z')))
            return void(unsure = true);
        if (m) note('M', *m);
        if (m && !machine_code(static_cast<int>(*m))) return;
        for (const auto& [letter, value] : words)
            if (std::string("GXYZIJRFSTMHP").find(letter) == std::string::npos)
                return void(unsure = true);
        const auto p = find(words, 'P');
        if (p && !(cycle_ && drill_dwells_)) return void(unsure = true);
        if (p) drill_dwell_s_ = *p * 0.001;
        if (find(words, 'H').has_value() != length_code) return void(unsure = true);
        if (length_code) {
            if (!find(words, 'Z') || cycle_) return void(unsure = true);
            const auto length = length_of_.find(static_cast<int>(*find(words, 'H')));
            if (length == length_of_.end()) return void(unsure = true);
            length_ = length->second;
        }
        if (cycle_) return drill(words);
        if (find(words, 'R')) return void(unsure = true);
        const bool moves = find(words, 'X') || find(words, 'Y') || find(words, 'Z');
        const bool centre = find(words, 'I') || find(words, 'J');
        if (motion_ == 9 && moves) return void(unsure = true);
        if (centre && motion_ < 2) return void(unsure = true);
        if (motion_ >= 2 && (moves || centre)) return arc(words);
        if (moves) line_to(target(words), motion_ == 0);
        if (m && (*m == 5 || *m == 9)) machine_off(static_cast<int>(*m));
    }

    /// False: the program ends, or the code is not for this reader.
    bool machine_code(int m) {
        switch (m) {
            case 3: turning_ = 1; return true;
            case 4: turning_ = -1; return true;
            case 5:
            case 9: machine_off(m); return true;  // alone in its block in these programs
            case 6: tool_ = chosen_; return true;
            case 7:
            case 8: coolant_ = true; return true;
            case 0:
            case 1: return true;
            case 2:
            case 30: done_ = true; return false;
            default: unsure = true; return false;
        }
    }
    void machine_off(int m) {
        if (m == 5) turning_ = 0;
        if (m == 9) coolant_ = false;
    }

    void note(char kind, double value) { functions.push_back({kind, value, moves.size()}); }

    void dwell(const Words& words) {
        for (const auto& [letter, value] : words)
            if (letter != 'G' && letter != 'P') return void(unsure = true);
        if (words.size() != 2 || !find(words, 'P')) return void(unsure = true);
        note('D', *find(words, 'P') * 0.001);
    }

    double unit() const { return inch_ ? 25.4 : 1.0; }
    double program_z() const { return gauge_[2] - g54_[2] - length_; }

    std::array<double, 3> target(const Words& words) const {
        std::array<double, 3> to = gauge_;
        for (std::size_t k = 0; k < 3; ++k)
            if (const auto v = find(words, "XYZ"[k]))
                to[k] = incremental_ ? gauge_[k] + *v * unit()
                                     : *v * unit() + g54_[k] + (k == 2 ? length_ : 0.0);
        return to;
    }

    std::array<double, 3> tip(std::array<double, 3> gauge) const {
        gauge[2] -= length_;
        return gauge;
    }

    PlainMove& begin(bool rapid) {
        PlainMove move;
        move.rapid = rapid;
        if (!rapid) {
            move.feed = feed_;
            move.spindle = turning_ * speed_;
            move.tool = tool_;
            move.coolant = coolant_;
            if (feed_ <= 0.0) stopped = true;
        }
        move.tips_mm.push_back(tip(gauge_));
        moves.push_back(move);
        return moves.back();
    }

    void line_to(const std::array<double, 3>& to, bool rapid) {
        if (to == gauge_) return;
        PlainMove& move = begin(rapid);
        gauge_ = to;
        move.tips_mm.push_back(tip(gauge_));
        check_travel();
    }

    void check_travel() {
        if (std::abs(gauge_[0]) > 400 || std::abs(gauge_[1]) > 400 || gauge_[2] < -150 ||
            gauge_[2] > 500)
            stopped = true;
    }

    void arc(const Words& words) {
        const double i = find(words, 'I').value_or(0) * unit(),
                     j = find(words, 'J').value_or(0) * unit();
        if (!find(words, 'I') && !find(words, 'J')) return void(unsure = true);
        if (std::hypot(i, j) < 1e-6) return void(unsure = true);
        const std::array<double, 3> to = target(words), from = gauge_;
        const double cx = from[0] + i, cy = from[1] + j;
        const double r0 = std::hypot(i, j), r1 = std::hypot(to[0] - cx, to[1] - cy);
        if (r1 < 1e-6) return void(unsure = true);
        const double two_pi = 2.0 * std::acos(-1.0);
        const double start = std::atan2(-j, -i);
        double sweep = std::atan2(to[1] - cy, to[0] - cx) - start;
        const bool closed = std::hypot(to[0] - from[0], to[1] - from[1]) < 1e-9;
        if (motion_ == 3)
            while (sweep <= (closed ? 1e-9 : 0.0)) sweep += two_pi;
        else
            while (sweep >= (closed ? -1e-9 : 0.0)) sweep -= two_pi;
        if (closed) sweep = motion_ == 3 ? two_pi : -two_pi;
        PlainMove& move = begin(false);
        for (int k = 1; k <= 300; ++k) {
            const double s = k / 300.0, r = r0 + s * (r1 - r0), angle = start + s * sweep;
            move.tips_mm.push_back(tip({cx + r * std::cos(angle), cy + r * std::sin(angle),
                                        from[2] + s * (to[2] - from[2])}));
        }
        gauge_ = to;
        check_travel();
    }

    void drill(const Words& words) {
        if (incremental_ || find(words, 'I') || find(words, 'J')) return void(unsure = true);
        if (const auto r = find(words, 'R')) return_z_ = *r * unit() + g54_[2] + length_;
        if (const auto z = find(words, 'Z')) depth_z_ = *z * unit() + g54_[2] + length_;
        if (!find(words, 'X') && !find(words, 'Y')) {
            // Whether such a block drills depends on more than is read here.
            if (find(words, 'Z') || find(words, 'R') || words.size() > 1) unsure = true;
            return;
        }
        if (!return_z_ || !depth_z_ || *depth_z_ >= *return_z_) return void(unsure = true);
        std::array<double, 3> to = target(words);
        to[2] = gauge_[2];
        line_to(to, true);
        line_to({to[0], to[1], *return_z_}, true);
        line_to({to[0], to[1], *depth_z_}, false);
        if (drill_dwells_ && drill_dwell_s_ > 0.0) note('D', drill_dwell_s_);
        const double up = to_initial_ ? initial_z_ + g54_[2] + length_ : *return_z_;
        line_to({to[0], to[1], up}, true);
        if (to_initial_ && up < *return_z_) unsure = true;
    }

    std::array<double, 3> g54_;  ///< in force
    std::array<double, 3> first_, second_;
    std::map<int, double> length_of_;
    std::array<double, 3> gauge_{};
    double length_ = 0.0, feed_ = 0.0, speed_ = 0.0, initial_z_ = 0.0;
    std::optional<double> return_z_, depth_z_;
    int motion_ = 0, turning_ = 0, tool_ = 0, chosen_ = 0;
    bool cycle_ = false, incremental_ = false, inch_ = false, coolant_ = false, to_initial_ = true;
    bool done_ = false, drill_dwells_ = false;
    double drill_dwell_s_ = 0.0;
};

}  // namespace trunnion::testing
