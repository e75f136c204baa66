// Runs every program of tests/nc and holds it to what its comments expect.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "base/units.h"
#include "controller/alarms.h"
#include "expectation.h"

namespace trunnion::nc {

namespace {

constexpr double tolerance = 1e-6;  // mm, deg; a few places more than anybody writes

class Recorder : public motion::MotionSink {
  public:
    explicit Recorder(double skip_at) : skip_at_(skip_at) {}
    motion::MoveResult move(const motion::AxisMove& m) override {
        moves.push_back(m);
        halfway = m;  // looked at now: the curve lives only as long as the call
        halfway.to = m.at(0.5);
        halfway.curve = nullptr;
        moves.back().curve = nullptr;
        if (m.until_skip && skip_at_ >= 0.0) return {true, m.at(skip_at_)};
        return {};
    }
    void m_code(int code) override { m_codes.push_back(code); }

    std::vector<motion::AxisMove> moves;
    motion::AxisMove halfway;
    std::vector<int> m_codes;

  private:
    double skip_at_;
};

double word_of(const motion::AxisMove& m, char letter) {
    if (letter == 'F') return m.feed_mm_min;
    if (letter == 'S') return m.spindle_rpm;
    if (letter >= 'I' && letter <= 'K')
        return m.arc ? m.arc->centre_mm[letter - 'I'] : std::nan("");
    const Axis axis = *axis_of(letter);
    return is_rotary(axis) ? deg_from_rad(m.to[axis]) : m.to[axis];
}

std::string describe(const motion::AxisMove& m) {
    std::ostringstream out;
    out << "G" << static_cast<int>(m.kind);
    for (const char letter : {'X', 'Y', 'Z', 'B', 'C'}) out << " " << letter << word_of(m, letter);
    if (m.arc)
        out << " I" << m.arc->centre_mm.x() << " J" << m.arc->centre_mm.y() << " K"
            << m.arc->centre_mm.z();
    return out.str();
}

bool matches(const motion::AxisMove& m, const ExpectedMove& expected) {
    static const char* const kinds[] = {"G0", "G1", "G2", "G3"};
    if (!expected.kind.empty() && expected.kind != kinds[static_cast<int>(m.kind)]) return false;
    for (const auto& [letter, value] : expected.words)
        if (!(std::abs(word_of(m, letter) - value) <= tolerance * std::max(1.0, std::abs(value))))
            return false;
    return true;
}

struct Outcome {
    controller::RunResult result;
    std::vector<motion::AxisMove> moves;
    motion::AxisMove halfway;  ///< of the last move
    std::vector<int> m_codes;
    std::string printed;
    std::map<int, double> variables;
};

Outcome run(const std::string& name, const std::string& text, Expectation& e) {
    Outcome out;
    Recorder sink(e.skip_at);
    interpreter::ProgramsInMemory programs;
    for (const int number : e.outside) programs.add(number, text);
    controller::Controller control(e.config, e.stores, programs, sink,
                                   [&](std::string_view printed) { out.printed += printed; });
    for (const auto& [number, value] : e.preset) control.set_variable(number, value);
    const auto owner = std::make_shared<const std::string>(text);
    out.result = control.run(interpreter::ProgramText{name, *owner, owner});
    for (const auto& [number, value] : e.variables)
        out.variables[number] = control.variable(number);
    out.moves = std::move(sink.moves);
    out.halfway = sink.halfway;
    out.m_codes = std::move(sink.m_codes);
    return out;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> out;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
        if (!line.empty()) out.push_back(line);
    }
    return out;
}

bool one_contains(const std::vector<std::string>& texts, const std::string& part) {
    for (const std::string& text : texts)
        if (text.find(part) != std::string::npos) return true;
    return false;
}

void check_alarm(const Expectation& e, const controller::RunResult& result) {
    if (!e.alarm) {
        if (result.alarm)
            FAIL_CHECK(controller::alarm_title(result.alarm->number, result.alarm->text)
                       << " at line " << result.alarm->where.line);
        return;
    }
    if (!result.alarm) {
        FAIL_CHECK("no alarm, expected " << *e.alarm);
        return;
    }
    CHECK(result.alarm->number == *e.alarm);
    CHECK(result.alarm->where.line > 0);
    if (e.alarm_line) CHECK(result.alarm->where.line == *e.alarm_line);
    if (e.alarm_column) CHECK(result.alarm->where.column == *e.alarm_column);
    CHECK(result.alarm->text.find(e.alarm_text) != std::string::npos);
}

void check_moves(const Expectation& e, const std::vector<motion::AxisMove>& moves) {
    if (e.move_count) CHECK(moves.size() == *e.move_count);
    if (e.last) {
        REQUIRE_FALSE(moves.empty());
        INFO("last move: " << describe(moves.back()));
        CHECK(matches(moves.back(), *e.last));
    }
    if (e.moves.empty()) return;
    CHECK(moves.size() == e.moves.size());
    for (std::size_t i = 0; i < std::min(moves.size(), e.moves.size()); ++i) {
        INFO("move " << i + 1 << ": " << describe(moves[i]));
        CHECK(matches(moves[i], e.moves[i]));
    }
}

void check_rest(const Expectation& e, const Outcome& out) {
    if (e.halfway) {
        INFO("halfway: " << describe(out.halfway));
        CHECK(matches(out.halfway, *e.halfway));
    }
    for (const auto& [number, value] : e.variables) {
        INFO("#" << number);
        const double is = out.variables.at(number);
        if (!value)
            CHECK(interpreter::is_vacant(is));
        else
            CHECK(is == Approx(*value).margin(1e-9).epsilon(1e-9));
    }
    if (!e.printed.empty()) CHECK(lines_of(out.printed) == e.printed);
    for (const std::string& note : e.notes) {
        INFO("note: " << note);
        CHECK(one_contains(out.result.notes, note));
    }
    if (e.no_note) CHECK(out.result.notes.empty());
    for (const std::string& code : e.modal) {
        INFO(code);
        CHECK(std::find(out.result.modal.begin(), out.result.modal.end(), code) !=
              out.result.modal.end());
    }
    for (const int code : e.m_codes) {
        INFO("M" << code);
        CHECK(std::find(out.m_codes.begin(), out.m_codes.end(), code) != out.m_codes.end());
    }
    if (e.time_s) CHECK(out.result.time_s == Approx(*e.time_s));
    if (e.limit) CHECK(out.result.status == controller::RunStatus::limit);
}

std::vector<std::filesystem::path> programs_in_corpus() {
    std::vector<std::filesystem::path> out;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(TRUNNION_SOURCE_DIR "/tests/nc"))
        if (entry.path().extension() == ".nc") out.push_back(entry.path());
    std::sort(out.begin(), out.end());
    return out;
}

std::string text_of(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

}  // namespace

TEST_CASE("every program of the corpus does what its comments expect") {
    const auto programs = programs_in_corpus();
    CHECK(programs.size() > 400);
    for (const auto& path : programs) {
        INFO(path.string());
        const std::string text = text_of(path);
        Expectation e;
        try {
            e = read_expectation(text);
        } catch (const std::exception& fault) {
            FAIL_CHECK("cannot read the expectation: " << fault.what());
            continue;
        }
        CHECK(e.count > 0);
        const Outcome out = run(path.filename().string(), text, e);
        check_alarm(e, out.result);
        check_moves(e, out.moves);
        check_rest(e, out);
    }
}

TEST_CASE("every alarm of the tables is reached by a program of the corpus") {
    std::set<int> reached;
    for (const auto& path : programs_in_corpus())
        if (const Expectation e = read_expectation(text_of(path)); e.alarm)
            reached.insert(*e.alarm);
    for (const controller::AlarmRow& row : controller::alarm_table()) {
        INFO(controller::alarm_title(row.number, row.text));
        CHECK(reached.count(row.number) == 1);
    }
}

}  // namespace trunnion::nc
