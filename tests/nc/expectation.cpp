#include "expectation.h"

#include <algorithm>
#include <initializer_list>
#include <sstream>
#include <stdexcept>

#include "base/units.h"

namespace trunnion::nc {

namespace {

std::vector<std::string> comments_of(const std::string& text) {
    std::vector<std::string> out;
    for (std::size_t from = text.find('('); from != std::string::npos;
         from = text.find('(', from + 1)) {
        const std::size_t to = text.find(')', from);
        if (to == std::string::npos) break;
        out.push_back(text.substr(from + 1, to - from - 1));
    }
    return out;
}

ExpectedMove read_move(std::istringstream& in) {
    ExpectedMove move;
    for (std::string word; in >> word;) {
        if (word[0] == 'G')
            move.kind = word;
        else
            move.words[word[0]] = std::stod(word.substr(1));
    }
    return move;
}

std::string rest_of(std::istringstream& in) {
    std::string rest;
    std::getline(in >> std::ws, rest);
    return rest;
}

double value_after_equals(std::istringstream& in) {
    std::string equals;
    double value = 0.0;
    if (!(in >> equals >> value) || equals != "=") throw std::runtime_error("no value");
    return value;
}

void read_expected_variable(Expectation& e, int number, std::istringstream& in) {
    std::string equals, value;
    in >> equals >> value;
    if (value == "VACANT")
        e.variables[number] = std::nullopt;
    else
        e.variables[number] = std::stod(value);
}

void read_expect(Expectation& e, std::istringstream& in) {
    ++e.count;
    std::string what;
    in >> what;
    if (what[0] == '#') return read_expected_variable(e, std::stoi(what.substr(1)), in);
    if (what == "MOVE") return e.moves.push_back(read_move(in));
    if (what == "LAST") return void(e.last = read_move(in));
    if (what == "HALFWAY") return void(e.halfway = read_move(in));
    if (what == "MOVES") return void(e.move_count = std::stoul(rest_of(in)));
    if (what == "ALARM") {
        int number = 0, line = 0;
        std::string word;
        in >> number;
        e.alarm = number;
        if (in >> word >> line) e.alarm_line = line;
        if (in >> word >> line) e.alarm_column = line;
        return;
    }
    if (what == "TEXT") return void(e.alarm_text = rest_of(in));
    if (what == "PRINT") {
        std::string text;
        in.get();
        std::getline(in, text);
        return e.printed.push_back(text);
    }
    if (what == "NOTE") return e.notes.push_back(rest_of(in));
    if (what == "NO") return void(e.no_note = true);
    if (what == "TIME") return void(e.time_s = std::stod(rest_of(in)));
    if (what == "MODAL") return e.modal.push_back(rest_of(in));
    if (what == "MCODE") return e.m_codes.push_back(std::stoi(rest_of(in)));
    if (what == "LIMIT") return void(e.limit = true);
    throw std::runtime_error("EXPECT " + what + "?");
}

controller::ControlAxis& axis_named(Expectation& e, char letter) {
    for (controller::ControlAxis& axis : e.config.axes)
        if (letter_of(axis.axis) == letter) return axis;
    throw std::runtime_error("no such axis");
}

void set_tool(Expectation& e, std::istringstream& in) {
    std::size_t number = 0;
    std::string equals;
    offsets::ToolOffset tool;
    in >> number >> equals >> tool.length_geometry_mm >> tool.radius_geometry_mm;
    e.stores.tools.tool.at(number) = tool;
}

void set_limit(Expectation& e, std::istringstream& in) {
    char letter = 0;
    double min = 0.0, max = 0.0;
    in >> letter >> min >> max;
    controller::ControlAxis& axis = axis_named(e, letter);
    axis.min = axis.rotary ? rad_from_deg(min) : min;
    axis.max = axis.rotary ? rad_from_deg(max) : max;
}

void set_reference(Expectation& e, std::istringstream& in) {
    int position = 0;
    char letter = 0;
    double value = 0.0;
    in >> position >> letter >> value;
    const std::string letters = "XYZBC";
    e.stores.parameters.entry[1239 + position].by_axis[static_cast<int>(letters.find(letter)) + 1] =
        value;
}

/// Switches of [control.hurco] away from their defaults.
void set_hurco(Expectation& e, const std::string& name) {
    controller::HurcoChoices& h = e.config.hurco;
    const std::map<std::string, bool*> switches = {
        {"LENGTH FROM M6", &h.length_from_tool_change},
        {"G49 KEEPS", &h.g49_keeps_tool_length},
        {"RAPIDS INTERPOLATED", &h.rapids_are_interpolated},
        {"M128 KEEPS TIP", &h.m128_keeps_tip_between_ends},
        {"PLANES STACK", &h.planes_stack},
        {"MOVED AXES", &h.g68_2_moved_axes},
        {"G86 FEEDS OUT", &h.g86_feeds_out},
        {"G98 FROM R", &h.g98_feeds_from_r},
        {"CLAMPS ALARM", &h.clamps_alarm}};
    const auto found = switches.find(name);
    if (found == switches.end()) throw std::runtime_error("SET HURCO " + name + "?");
    *found->second = !*found->second;
}

void set_axes(Expectation& e, const std::string& letters) {
    e.config.axes.clear();
    for (const char letter : letters) {
        controller::ControlAxis entry;
        entry.axis = *axis_of(letter);
        entry.rotary = is_rotary(entry.axis);
        e.config.axes.push_back(entry);
    }
}

/// 19680-19689 of a machine, then six lengths from `first` and `second` on.
void set_unit(Expectation& e, std::istringstream& in,
              std::initializer_list<std::pair<int, double>> unit, int first, int second) {
    for (const auto& [number, value] : unit) e.stores.parameters.set(number, value);
    e.stores.parameters.set(19697, 3);
    for (const int vector : {first, second})
        for (int i = 0; i < 3; ++i) {
            double value_mm = 0.0;
            if (!(in >> value_mm)) throw std::runtime_error("SET TABLE, HEAD, MIXED: six lengths");
            e.stores.parameters.set(vector + i, value_mm);
        }
}

/// Table: B carries C, both turn left-handed (ISO 841), the usual trunnion of five_axes(). Head: C
/// carries B. Mixed: B in the head, C left-handed in the table.
void set_machine(Expectation& e, const std::string& what, std::istringstream& in) {
    if (what == "TABLE")
        set_unit(
            e, in,
            {{19680, 12}, {19681, 4}, {19682, 2}, {19684, 1}, {19686, 5}, {19687, 3}, {19689, 1}},
            19700, 19703);
    else if (what == "HEAD")
        set_unit(e, in, {{19680, 2}, {19681, 5}, {19682, 3}, {19686, 4}, {19687, 2}}, 19709, 19712);
    else
        set_unit(e, in, {{19680, 21}, {19681, 4}, {19682, 2}, {19686, 5}, {19687, 3}, {19689, 1}},
                 19709, 19700);
}

void read_set(Expectation& e, std::istringstream& in) {
    std::string what;
    in >> what;
    int number = 0;
    if (what[0] == '#') {
        e.preset[std::stoi(what.substr(1))] = value_after_equals(in);
    } else if (what == "PARAMETER") {
        in >> number;
        e.stores.parameters.set(number, value_after_equals(in));
    } else if (what == "BIT") {
        std::string name;
        in >> name;
        const std::size_t hash = name.find('#');
        e.stores.parameters.set_bit(std::stoi(name.substr(0, hash)),
                                    std::stoi(name.substr(hash + 1)), value_after_equals(in) != 0);
    } else if (what == "TOOL") {
        set_tool(e, in);
    } else if (what == "SKIP") {
        in >> e.skip_at;
    } else if (what == "LIMIT") {
        set_limit(e, in);
    } else if (what == "STROKE") {
        char letter = 0;
        double min = 0.0, max = 0.0;
        in >> letter >> min >> max;
        const int axis = static_cast<int>(std::string("XYZBC").find(letter)) + 1;
        e.stores.parameters.entry[1320].by_axis[axis] = max;
        e.stores.parameters.entry[1321].by_axis[axis] = min;
    } else if (what == "REFERENCE") {
        set_reference(e, in);
    } else if (what == "CLAMP") {
        char letter = 0;
        controller::ClampCode clamp;
        in >> letter >> clamp.m_clamp >> clamp.m_release;
        clamp.axis = axis_named(e, letter).axis;
        clamp.alarm = true;
        e.config.clamps.push_back(clamp);
    } else if (what == "DIALECT") {
        const std::string name = rest_of(in);
        if (name.starts_with("HURCO")) e.config.dialect = interpreter::hurco_dialect();
        e.config.hurco.bnc = name == "HURCO BNC";
        if (name == "16I")
            e.config.dialect =
                interpreter::fanuc_dialect(interpreter::ControlGeneration::fanuc_16i);
    } else if (what == "SWITCH") {
        in >> number;
        e.config.skip_switches.at(static_cast<std::size_t>(number)) = true;
    } else if (what == "SIGNAL") {
        in >> number;
        e.stores.signals[number] = value_after_equals(in);
    } else if (what == "OUTSIDE") {
        in >> number;
        e.outside.push_back(number);
    } else if (what == "OPTIONAL") {
        e.config.optional_stop = true;
    } else if (what == "BLOCKS") {
        in >> number;
        e.config.max_blocks = static_cast<std::uint64_t>(number);
    } else if (what == "TABLE" || what == "HEAD" || what == "MIXED") {
        set_machine(e, what, in);
    } else if (what == "HURCO") {
        set_hurco(e, rest_of(in));
    } else if (what == "AXES") {
        set_axes(e, rest_of(in));
    } else if (what == "AC") {
        set_unit(
            e, in,
            {{19680, 12}, {19681, 4}, {19682, 1}, {19684, 1}, {19686, 5}, {19687, 3}, {19689, 1}},
            19700, 19703);
    } else if (what == "TCP") {
        e.config.tcp_frame = positioning::TcpFrame::rotary_zero;
    } else if (what == "POSITIONS") {
        e.config.work_positions_with_length = false;
    } else if (what == "G53") {
        e.config.g53_under_g91_moves = true;
    } else if (what == "GROUP") {
        e.config.work_offset_is_group_12 = true;
    } else {
        throw std::runtime_error("SET " + what + "?");
    }
}

}  // namespace

Expectation read_expectation(const std::string& text) {
    Expectation e;
    e.config.dialect = interpreter::fanuc_dialect();
    set_axes(e, "XYZBC");
    for (const std::string& comment : comments_of(text)) {
        std::istringstream in(comment);
        std::string word;
        in >> word;
        if (word == "EXPECT") read_expect(e, in);
        if (word == "SET") read_set(e, in);
    }
    return e;
}

}  // namespace trunnion::nc
