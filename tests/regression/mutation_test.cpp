// 500 random single edits: what changes machining is found, what does not is not reported. The
// truth is made by dense samples of both programs, once as the control runs them and once as a
// plain reader does that shares no code with control or comparer.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "controller/controller.h"
#include "emulator/run.h"
#include "tests/regression/plain_interpreter.h"
#include "tests/regression/programs.h"
#include "tests/regression/random_edit.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

const std::string part_text = R"(%
O1000
G21 G90 G17 G94 G40 G49 G80
G54
T1 M6
S8000 M3
G0 X0. Y0.
G43 H1 Z20. M8
G0 X5. Y5.
Z2.
G1 Z-1. F300.
X45. F800.
Y25.
G3 X35. Y35. I-10. J0.
G1 X5.
Y5.
G0 Z10.
X60. Y10.
Z1.
G1 Z-2. F250.
G2 X60. Y10. I8. J0.
G91 G1 X4. Y3.
X-2. Y6.
G90 G1 X70. Y40. Z-1.
G0 Z20.
M9
M5
T2 M6
S3000 M3
G43 H2 Z20. M8
G0 X10. Y10.
G98 G81 X10. Y10. Z-6. R2. F120.
X20.
X30. Y15.
G80
G0 X0. Y50.
G99 G83 X5. Y50. Z-9. R2. Q3. F90.
X15. Y55.
G80
G0 Z20.
#101=5.
WHILE[#101LT9.]DO1
G1 X#101 Y[#101*2.] F400.
#101=#101+1.
END1
G0 Z30.
M9
M5
G28 G91 Z0.
G90
M30
%
)";

/// A stretch of one kind and one set of values, as points.
struct Stretch2 {
    bool rapid = true;
    double feed = 0, spindle = 0;
    int tool = 0;
    bool coolant = false;
    std::vector<Vector3> points;
    std::vector<double> lengths;
};

class Sampler : public motion::MotionSink {
  public:
    motion::MoveResult move(const motion::AxisMove& m) override {
        const auto tip = [&](double s) -> Vector3 {
            const AxisPositions at = m.at(s);
            return Vector3(at[Axis::X], at[Axis::Y], at[Axis::Z]) - m.tool_vector_mm;
        };
        const bool rapid = m.kind == motion::MotionKind::rapid;
        std::vector<Vector3> points{tip(0.0)};
        const int count = m.arc ? 300 : 1;
        for (int k = 1; k <= count; ++k) points.push_back(tip(static_cast<double>(k) / count));
        add({rapid, m.feed_mm_min, m.spindle_rpm, m.tool, m.coolant, {}, {}}, points);
        return {};
    }
    void add(Stretch2 now, const std::vector<Vector3>& points) {
        double length = 0.0;
        for (std::size_t k = 1; k < points.size(); ++k)
            length += (points[k] - points[k - 1]).norm();
        if (length < 1e-7) return;
        if (now.rapid) now = Stretch2{};
        if (stretches.empty() || !same_values(stretches.back(), now)) stretches.push_back(now);
        Stretch2& s = stretches.back();
        for (const Vector3& p : points) {
            s.lengths.push_back(s.points.empty() ? 0.0
                                                 : s.lengths.back() + (p - s.points.back()).norm());
            s.points.push_back(p);
        }
    }
    static bool same_values(const Stretch2& a, const Stretch2& b) {
        return a.rapid == b.rapid && std::abs(a.feed - b.feed) <= 0.005 * a.feed &&
               std::abs(a.spindle - b.spindle) <= 0.005 * std::abs(a.spindle) && a.tool == b.tool &&
               a.coolant == b.coolant;
    }
    std::vector<Stretch2> stretches;
    bool stopped = false;
};

Vector3 at_fraction(const Stretch2& s, double fraction) {
    const double wanted = fraction * s.lengths.back();
    const auto place = std::lower_bound(s.lengths.begin(), s.lengths.end(), wanted);
    const auto k = static_cast<std::size_t>(place - s.lengths.begin());
    if (k == 0) return s.points.front();
    const double step = s.lengths[k] - s.lengths[k - 1];
    const double t = step > 0.0 ? (wanted - s.lengths[k - 1]) / step : 0.0;
    return s.points[k - 1] + t * (s.points[k] - s.points[k - 1]);
}

Sampler sampled(const std::string& program, const setup::Setup& setup) {
    Sampler sink;
    offsets::Stores stores = setup.stores;
    interpreter::ProgramsInMemory programs;
    controller::ControlConfig config = emulator::control_config(setup);
    config.max_blocks = 3000;
    controller::Controller controller(config, stores, programs, sink, [](std::string_view) {});
    sink.stopped = controller.run(text_of("b.nc", program)).status != controller::RunStatus::ok;
    return sink;
}

/// Largest distance of the two runs at equal fractions of length; infinite where they do not pair.
double apart(const Sampler& a, const Sampler& b) {
    if (a.stopped || b.stopped || a.stretches.size() != b.stretches.size())
        return std::numeric_limits<double>::infinity();
    double worst = 0.0;
    for (std::size_t k = 0; k < a.stretches.size(); ++k) {
        if (!Sampler::same_values(a.stretches[k], b.stretches[k]))
            return std::numeric_limits<double>::infinity();
        for (int n = 0; n <= 1000; ++n)
            worst = std::max(worst, (at_fraction(a.stretches[k], n / 1000.0) -
                                     at_fraction(b.stretches[k], n / 1000.0))
                                        .norm());
    }
    return worst;
}

/// The plain reader's run; nothing where it is not sure.
std::optional<Sampler> plainly_sampled(const std::string& program, const setup::Setup& setup) {
    const offsets::OffsetVector& g54 = setup.stores.work.standard[0];
    PlainInterpreter reader({g54[Axis::X], g54[Axis::Y], g54[Axis::Z]}, {{1, 100.0}, {2, 80.0}});
    reader.run(program);
    if (reader.unsure) return std::nullopt;
    Sampler sink;
    sink.stopped = reader.stopped;
    for (const PlainMove& m : reader.moves) {
        std::vector<Vector3> points;
        for (const auto& p : m.tips_mm) points.emplace_back(p[0], p[1], p[2]);
        sink.add({m.rapid, m.feed, m.spindle, m.tool, m.coolant, {}, {}}, points);
    }
    return sink;
}

/// Lines, arcs, increments, drilling: what the plain reader knows.
const std::string plain_base = R"(%
O1000
G21 G90 G17 G94 G40 G80
G54
T1 M6
S8000 M3
G0 X0. Y0.
G43 H1 Z20.
M8
G0 X5. Y5.
Z2.
G1 Z-1. F300.
X45. F800.
Y25.
G3 X35. Y35. I-10. J0.
G1 X5.
Y5.
G0 Z10.
X60. Y10.
Z1.
G1 Z-2. F250.
G2 X60. Y10. I8. J0.
G91 G1 X4. Y3.
X-2. Y6.
G90 G1 X70. Y40. Z-1.
G0 Z20.
M9
M5
T2 M6
S3000 M3
G43 H2 Z20.
M8
G0 X10. Y10.
G98 G81 X10. Y10. Z-6. R2. F120.
X20.
X30. Y15.
G80
G0 X0. Y50.
G1 Z-3. F200.
G2 X10. Y60. I10. J0. F500.
G1 X40.
G2 X50. Y50. I0. J-10.
G1 Y30. F650.
G0 Z30.
M9
M5
M30
%
)";

/// One edit: a digit, a sign, a word removed, a line swapped with the next, a G code changed.
std::string edited(const std::string& program, SeededNoise& noise, std::size_t& line) {
    std::vector<std::string> lines = lines_of(program);
    for (;;) {
        line = 3 + pick(noise, lines.size() - 6);
        std::string& text = lines[line];
        const std::size_t at = text.empty() ? 0 : pick(noise, text.size());
        switch (pick(noise, 5)) {
            case 0:
                if (text[at] < '0' || text[at] > '9') continue;
                text[at] = static_cast<char>('0' + pick(noise, 10));
                break;
            case 1:
                if (std::string("XYZIJ").find(text[at]) == std::string::npos ||
                    at + 1 >= text.size())
                    continue;
                if (text[at + 1] == '-')
                    text.erase(at + 1, 1);
                else
                    text = text.substr(0, at + 1) + "-" + text.substr(at + 1);
                break;
            case 2: {
                const std::size_t from = text.rfind(' ', at);
                if (from == std::string::npos) continue;
                text.erase(from, text.find(' ', from + 1) - from);
                break;
            }
            case 3: std::swap(lines[line], lines[line + 1]); break;
            default:
                if (text[at] != 'G' || at + 1 >= text.size()) continue;
                text = text.substr(0, at + 1) + static_cast<char>('0' + pick(noise, 4)) +
                       text.substr(std::min(text.find(' ', at), text.size()));
        }
        std::string out;
        for (std::size_t k = 0; k + 1 < lines.size(); ++k) out += lines[k] + "\n";
        return out;
    }
}

}  // namespace

TEST_CASE("500 random edits: found when machining changes, silent when it does not", "[compare]") {
    setup::Setup setup = bc_table();
    setup.stores.tools.tool[1].length_geometry_mm = 100.0;
    setup.stores.tools.tool[2].length_geometry_mm = 80.0;
    const Sampler truth = sampled(part_text, setup);
    REQUIRE_FALSE(truth.stopped);
    REQUIRE(truth.stretches.size() > 20);
    SeededNoise noise(20260101);
    int changed = 0, same = 0, near_tolerance = 0;
    for (int k = 0; k < 500; ++k) {
        std::size_t line = 0;
        const std::string b = edited(part_text, noise, line);
        const double distance = apart(truth, sampled(b, setup));
        regression::CompareOptions options = only(regression::Layer::path);
        options.max_blocks = 3000;
        if (distance > 0.0025 && distance < 0.01) {
            ++near_tolerance;
            continue;
        }
        const regression::Comparison r = compare_texts(part_text, b, setup, options);
        const bool differs = distance > 0.005;
        INFO("edit " << k << " line " << line + 1 << ": '" << lines_of(b)[line] << "' was '"
                     << lines_of(part_text)[line] << "', " << distance
                     << " mm apart: " << r.verdict);
        CHECK(r.equal != differs);
        if (differs && r.status == regression::CompareStatus::differs)
            CHECK(std::max(r.differences.front().a.line, r.differences.front().b.line) >=
                  static_cast<int>(line));
        ++(differs ? changed : same);
    }
    WARN("500 edits: " << changed << " change machining, " << same << " do not, " << near_tolerance
                       << " too near the tolerance to call");
    CHECK(changed > 200);
    CHECK(same > 20);
}

TEST_CASE("500 random edits judged by a plain reader that shares no code with the control",
          "[compare]") {
    setup::Setup setup = bc_table();
    setup.stores.tools.tool[1].length_geometry_mm = 100.0;
    setup.stores.tools.tool[2].length_geometry_mm = 80.0;
    const auto truth = plainly_sampled(plain_base, setup);
    REQUIRE(truth);
    REQUIRE_FALSE(truth->stopped);
    // Both readings of the unchanged program agree.
    REQUIRE(apart(*truth, sampled(plain_base, setup)) < 1e-6);
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
        SeededNoise noise(seed);
        int changed = 0, same = 0, unsure = 0, wrong_place = 0;
        while (changed + same < 500) {
            std::size_t line = 0;
            const std::string b = edited(plain_base, noise, line);
            const auto run = plainly_sampled(b, setup);
            const double distance = run ? apart(*truth, *run) : 0.0;
            if (!run || (distance > 0.0025 && distance < 0.01)) {
                ++unsure;
                continue;
            }
            regression::CompareOptions options = only(regression::Layer::path);
            options.max_blocks = 3000;
            const regression::Comparison r = compare_texts(plain_base, b, setup, options);
            const bool differs = distance > 0.005;
            INFO("seed " << seed << " line " << line + 1 << ": '" << lines_of(b)[line] << "' was '"
                         << lines_of(plain_base)[line] << "', " << distance
                         << " mm apart: " << r.verdict);
            CHECK(r.equal != differs);
            // The edited line is the first or second of the block that is named, or before it
            // where it only sets what a later block uses.
            if (differs && r.status == regression::CompareStatus::differs &&
                std::max(r.differences.front().a.line, r.differences.front().b.line) <
                    static_cast<int>(line) + 1)
                ++wrong_place;
            ++(differs ? changed : same);
        }
        WARN("seed " << seed << ": " << changed << " change machining, " << same << " do not, "
                     << unsure << " more not judged");
        CHECK(wrong_place == 0);
        CHECK(changed > 200);
        CHECK(same > 20);
    }
}
