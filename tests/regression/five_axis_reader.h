// A plain reading of five-axis programs on a table with B and C, written for the edits alone: it
// shares nothing with the control. What it cannot judge for sure it says so.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "geometry/pose.h"

namespace trunnion::testing {

/// A point of the path in the table frame, with the unit vector from tip to spindle.
struct TablePoint {
    Vector3 tip_mm = Vector3::Zero(), axis = Vector3::UnitZ();
};

/// One move. Of a rapid only the end is known for sure.
struct TableMove {
    bool rapid = true;
    double feed = 0.0;  ///< mm/min, or 1/min where `by_time`
    bool by_time = false;
    double spindle = 0.0;
    bool coolant = false;
    int tool = 0;
    std::vector<TablePoint> points;  ///< start to end; rapids: the end
};

/// G0 G1, G2 G3 with I J K in three planes, G43 G43.4 G49 with H, G68.2 with I J K, G53.1, G69, G93
/// G94, plain M codes; G54 and the crossing of B and C at machine zero.
class FiveAxisReader {
  public:
    bool unsure = false;
    std::vector<TableMove> moves;

    void run(const std::string& program) {
        std::size_t at = 0;
        while (at < program.size() && !done_ && !unsure) {
            const std::size_t end = std::min(program.find('\n', at), program.size());
            const std::string line = program.substr(at, end - at);
            if (!line.empty() && line[0] != '%' && line[0] != 'O') block(line);
            at = end + 1;
        }
    }

  private:
    enum class Frame { table, tcp, plane };

    void block(const std::string& line) {
        words_.clear();
        codes_.clear();
        for (std::size_t at = 0; at < line.size();) {
            if (line[at] == ' ') {
                ++at;
                continue;
            }
            const char letter = line[at++];
            const std::size_t end = std::min(line.find(' ', at), line.size());
            if (!take_word(letter, line.substr(at, end - at))) return void(unsure = true);
            at = end;
        }
        obey();
    }

    bool take_word(char letter, const std::string& number) {
        if (number.empty() || number.find_first_not_of("+-.0123456789") != std::string::npos)
            return false;
        if (number.find_first_of("+-", 1) != std::string::npos ||
            number.find('.') != number.rfind('.') ||
            number.find_first_of("0123456789") == std::string::npos)
            return false;
        const double value = std::stod(number);
        if (letter == 'G') return codes_.push_back(static_cast<int>(std::lround(10 * value))), true;
        const bool length = std::string("XYZBCIJKF").find(letter) != std::string::npos;
        if (length && number.find('.') == std::string::npos) return false;
        return words_.emplace(letter, value).second;  // a letter twice: not for this reader
    }

    bool has(char letter) const { return words_.contains(letter); }
    bool has_any(const std::string& letters) const {
        return std::any_of(letters.begin(), letters.end(), [&](char l) { return has(l); });
    }

    void obey() {
        if (codes_.size() > 1 && !words_.empty() && line_has_special()) return void(unsure = true);
        bool used = false;  // the axis words belong to a code
        for (const int code : codes_) used = code_is_taken(code) || used;
        if (unsure) return;
        if (has('S')) speed_ = words_.at('S');
        if (has('F')) feed_ = words_.at('F');
        if (has('M') && !machine_code(static_cast<int>(words_.at('M')))) return;
        if (has_any("DEAHKPQRUVWL") && !(has('H') && used_h_) &&
            !(has('K') && (used || motion_ > 1)))
            return void(unsure = true);
        used_h_ = false;
        if (!used && has_any("XYZBCIJK")) motion_ > 1 ? arc() : straight();
    }

    bool line_has_special() const {
        return std::any_of(codes_.begin(), codes_.end(), [](int code) {
            return code == 430 || code == 434 || code == 682 || code == 531 || code == 690 ||
                   code == 490;
        });
    }

    /// True where the code takes the block's X Y Z itself.
    bool code_is_taken(int code) {
        switch (code) {
            case 0:
            case 10:
            case 20:
            case 30: motion_ = code / 10; return false;
            case 170:
            case 180:
            case 190: plane_ = code / 10; return false;
            case 930:
            case 940: by_time_ = code == 930; return false;
            case 430:
            case 434: return length_on(code == 434);
            case 490:
                unsure = unsure || has_any("XYZBCIJK");
                compensated_ = false;
                if (frame_ == Frame::tcp) forget_end();
                if (frame_ == Frame::tcp) frame_ = Frame::table;
                return false;
            case 682: return tilt();
            case 531:
                unsure = unsure || !tilted_ || compensated_ || has_any("XYZBCIJK");
                if (tilted_) turned_to_plane_ = true;
                frame_ = Frame::plane;
                return false;
            case 690:
                // Where the table stands behind G53.1 depends on the solution: not for this reader.
                tilted_ = false;
                lost_ = turned_to_plane_;
                frame_ = Frame::table;
                return false;
            case 210:
            case 400:
            case 540:
            case 800:
            case 900: return false;
            default: unsure = true; return false;
        }
    }

    bool length_on(bool tcp) {
        const bool known = has('H') && words_.at('H') == 1.0 && motion_ < 2 && !lost_;
        if (!known || compensated_ ||
            (tcp &&
             (frame_ != Frame::table || b_deg_ != 0.0 || c_deg_ != 0.0 || has_any("XYZBCIJK"))))
            return unsure = true;
        used_h_ = true;
        compensated_ = true;
        if (!tcp) return false;
        frame_ = Frame::tcp;
        forget_end();
        return true;
    }

    bool tilt() {
        if (compensated_ || tilted_ || lost_ || !has('I') || !has('J') || !has('K') || has('B') ||
            has('C'))
            return unsure = true;
        const auto at = [&](char l) { return has(l) ? words_.at(l) : 0.0; };
        origin_mm_ = {at('X'), at('Y'), at('Z')};
        plane_rotation_ = turn(2, at('I')) * turn(0, at('J')) * turn(2, at('K'));
        tilted_ = true;
        forget_end();
        return true;
    }

    static Matrix3 turn(int axis, double deg) {
        const double angle = deg * std::acos(-1.0) / 180.0, c = std::cos(angle),
                     s = std::sin(angle);
        const int p = (axis + 1) % 3, q = (axis + 2) % 3;
        Matrix3 m = Matrix3::Identity();
        m(p, p) = m(q, q) = c;
        m(p, q) = -s;
        m(q, p) = s;
        return m;
    }

    /// The table turned by B and C: table frame seen from the machine; positive against the tool.
    Matrix3 table(double b_deg, double c_deg) const { return turn(1, -b_deg) * turn(2, -c_deg); }

    TablePoint at(const Vector3& p, double b_deg, double c_deg) const {
        if (frame_ == Frame::plane)
            return {origin_mm_ + plane_rotation_ * p, plane_rotation_.col(2)};
        const Matrix3 back = table(b_deg, c_deg).transpose();
        if (frame_ == Frame::tcp) return {p, back.col(2)};
        return {back * p, back.col(2)};
    }

    Vector3 target() const {
        Vector3 to = end_;
        for (int k = 0; k < 3; ++k)
            if (has("XYZ"[k])) to[k] = words_.at("XYZ"[k]);
        return to;
    }

    void forget_end() {
        known_end_ = false;
        said_ = {};
    }

    /// After a change of frame every coordinate must be said before it is known.
    bool all_known() {
        if (known_end_) return true;
        for (int k = 0; k < 3; ++k) said_[static_cast<std::size_t>(k)] |= has("XYZ"[k]);
        known_end_ = said_[0] && said_[1] && said_[2];
        return false;
    }

    void straight() {
        const double b = has('B') ? words_.at('B') : b_deg_, c = has('C') ? words_.at('C') : c_deg_;
        const bool turning = b != b_deg_ || c != c_deg_;
        if (has_any("IJK") || lost_ || (tilted_ && frame_ != Frame::plane) ||
            (frame_ == Frame::plane && turning))
            return void(unsure = true);
        const bool known = all_known();
        const Vector3 from = end_, to = target();
        const double from_b = b_deg_, from_c = c_deg_;
        end_ = to;
        b_deg_ = b;
        c_deg_ = c;
        if (motion_ == 0) {
            if (known_end_) moves.push_back({true, 0, false, 0, false, 0, {at(to, b, c)}});
            return;
        }
        if (!known || (turning && frame_ != Frame::tcp) || (to == from && !turning))
            return void(unsure = true);
        TableMove& move = cut();
        for (int k = 0; k <= 30; ++k) {
            const double s = k / 30.0;
            move.points.push_back(
                at(from + s * (to - from), from_b + s * (b - from_b), from_c + s * (c - from_c)));
        }
    }

    void arc() {
        if (!known_end_ || frame_ == Frame::tcp || lost_ || has('B') || has('C'))
            return void(unsure = true);
        const int p = plane_ == 17 ? 0 : plane_ == 18 ? 2 : 1, q = (p + 1) % 3, n = (p + 2) % 3;
        const auto offset = [&](int k) { return has("IJK"[k]) ? words_.at("IJK"[k]) : 0.0; };
        if (offset(n) != 0.0) return void(unsure = true);
        const Vector3 from = end_, to = target();
        const double cp = from[p] + offset(p), cq = from[q] + offset(q);
        const double r0 = std::hypot(from[p] - cp, from[q] - cq),
                     r1 = std::hypot(to[p] - cp, to[q] - cq);
        if (r0 < 1e-3 || std::abs(r1 - r0) > 0.005 || (to - from).norm() < 0.1)
            return void(unsure = true);
        const double start = std::atan2(from[q] - cq, from[p] - cp), two_pi = 2.0 * std::acos(-1.0);
        double sweep = std::atan2(to[q] - cq, to[p] - cp) - start;
        while (motion_ == 3 && sweep <= 0.0) sweep += two_pi;
        while (motion_ == 2 && sweep >= 0.0) sweep -= two_pi;
        TableMove& move = cut();
        for (int k = 0; k <= 60; ++k) {
            const double s = k / 60.0, r = r0 + s * (r1 - r0), angle = start + s * sweep;
            Vector3 place = from + s * (to - from);
            place[p] = cp + r * std::cos(angle);
            place[q] = cq + r * std::sin(angle);
            move.points.push_back(at(place, b_deg_, c_deg_));
        }
        end_ = to;
    }

    TableMove& cut() {
        unsure = unsure || feed_ <= 0.0 || !compensated_ || (by_time_ && !has('F'));
        moves.push_back({false, feed_, by_time_, turning_ * speed_, coolant_, tool_, {}});
        return moves.back();
    }

    bool machine_code(int m) {
        if (m == 3 || m == 4) turning_ = m == 3 ? 1 : -1;
        if (m == 5) turning_ = 0;
        if (m == 7 || m == 8) coolant_ = true;
        if (m == 9) coolant_ = false;
        if (m == 30) done_ = true;
        if (m == 6) tool_ = 1;
        if (m == 6) unsure = unsure || !has('T') || words_.at('T') != 1.0;
        const bool known = (m >= 3 && m <= 9) || m == 30;
        // M5 and M9 act behind the block's move: alone they are sure.
        unsure = unsure || !known || has_any("XYZBC");
        return known && !done_;
    }

    std::map<char, double> words_;
    std::vector<int> codes_;  ///< * 10
    Frame frame_ = Frame::table;
    Vector3 end_ = Vector3::Zero(), origin_mm_ = Vector3::Zero();
    Matrix3 plane_rotation_ = Matrix3::Identity();
    std::array<bool, 3> said_{};
    double b_deg_ = 0.0, c_deg_ = 0.0, feed_ = 0.0, speed_ = 0.0;
    int motion_ = 0, plane_ = 17, turning_ = 0, tool_ = 0;
    bool by_time_ = false, coolant_ = false, compensated_ = false, tilted_ = false, done_ = false;
    bool turned_to_plane_ = false, lost_ = false, known_end_ = false, used_h_ = false;
};

}  // namespace trunnion::testing
