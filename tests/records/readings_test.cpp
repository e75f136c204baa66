#include "records/readings.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "base/alarm.h"
#include "base/numbers.h"
#include "base/units.h"
#include "records/samples.h"

using namespace trunnion;

namespace {

const std::string header =
    "index,time_s,test,mode,device,feature,x_mm,b_deg,dir_x,dir_y,dir_z,value_mm\n";

records::ReadingTable read(const std::string& text) {
    std::vector<std::string> notes;
    return records::parse_readings(text, "r.csv", notes);
}

void check_fault(const std::string& text, const std::string& part, int line, int column) {
    INFO(text);
    try {
        read(text);
        FAIL("no error");
    } catch (const InputError& error) {
        CHECK_THAT(error.message, Catch::Contains(part));
        CHECK(error.where.line == line);
        CHECK(error.where.column == column);
        CHECK(error.where.program == "r.csv");
    }
}

std::string circle(double start_rad, double turns, int n) {
    std::string text = "index,time_s,test,device,feature,x_mm,y_mm,c_deg,value_mm\n";
    for (int i = 0; i <= n; ++i) {
        const double t = start_rad + 2 * pi * turns * i / n;
        text += std::to_string(i) + ',' + shortest(0.1 * i) + ",xy,ballbar,P," +
                shortest(100 * std::cos(t)) + ',' + shortest(100 * std::sin(t)) + ",30,0.001\n";
    }
    return text;
}

}  // namespace

TEST_CASE("a table is read with units, comments and unknown columns noted") {
    std::vector<std::string> notes;
    const records::ReadingTable table = records::parse_readings(
        "# schema = trunnion.readings/1\n# touches = "
        "9\n\nindex,time_s,test,device,feature,x_mm,b_deg,odd,"
        "value_mm,sigma_mm\r\n1,0.5,map,,S1,1.5,-30,9,,\r\n2,0.5,\"a,b\",ballbar,S1,1.5,-30,,0."
        "0123,0.001\r\n",
        "r.csv", notes);
    REQUIRE(table.rows.size() == 2);
    CHECK(table.comment.at("touches") == "9");
    CHECK(table.rows[0].device == records::Device::none);
    CHECK_FALSE(table.rows[0].value_mm);
    CHECK(table.rows[1].test == "a,b");
    CHECK(table.rows[1].commanded[Axis::B] == rad_from_deg(-30));
    CHECK(*table.rows[1].value_mm == 0.0123);
    CHECK(*table.rows[1].sigma_mm == 0.001);
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0], Catch::Contains("odd"));
}

TEST_CASE("a table is read as spreadsheets save it") {
    const std::string plain = "# schema = trunnion.readings/1\n# side = X+\n" + header +
                              "1,0,m,dpp,sphere,S1,1.5,-30,1,0,0,0.01\n";
    const records::ReadingTable table = read(plain);
    const auto same = [&](std::string text) {
        const records::ReadingTable other = read(text);
        REQUIRE(other.rows.size() == 1);
        CHECK(records::format_readings(other) == records::format_readings(table));
    };
    const auto wide = [](const std::string& text, bool little) {
        std::string out = little ? "\xFF\xFE" : "\xFE\xFF";
        for (const char c : text) {
            if (little) out += c;
            out += '\0';
            if (!little) out += c;
        }
        return out;
    };
    std::string tabs = plain, semicolons = plain;
    std::replace(tabs.begin(), tabs.end(), ',', '\t');
    std::replace(semicolons.begin(), semicolons.end(), ',', ';');
    for (const std::string& text : {tabs, semicolons, wide(plain, true), wide(plain, false),
                                    wide(tabs, true), "\xEF\xBB\xBF" + plain})
        same(text);
    std::string filled = plain;  // each line with as many cells
    filled.insert(filled.find("X+") + 2, ",,,,");
    filled.insert(filled.find("/1\n") + 2, ",,,,");
    same(filled);
    check_fault(wide(header + "1,0,m,dpp,,S1,1.x,-30,1,0,0,0.01\n", true), "not a finite number", 2,
                15);
    check_fault("index;time_s;test;device;feature;x_mm;value_mm\n1;0;m;;;1,5;0\n",
                "write a decimal point", 2, 9);
}

TEST_CASE("bad tables name the place") {
    check_fault("", "no header", 1, 1);
    check_fault(header + "1,5,t,,\"ball\"bar,P,0,0,,,,0\n", "behind a closed quote", 2, 14);
    check_fault("a,b\n", "not a table of readings", 1, 1);
    check_fault("time_s,value_mm\n", "column 'index' is missing", 1, 1);
    check_fault(header, "no rows", 1, 1);
    check_fault(header + "1,nan,t,,ballbar,P,0,0,,,,0\n", "not a finite number", 2, 3);
    check_fault(header + "1,0,t,,ballbar,P,inf,0,,,,0\n", "not a finite number", 2, 18);
    check_fault(header + "1,0,t,,ballbar,P,,0,,,,0\n", "not a finite number", 2, 18);
    check_fault(header + "1,0,t,,ruler,P,0,0,,,,0\n", "device is", 2, 8);
    check_fault(header + "1,0,t,dbb,ballbar,P,0,0,,,,0\n", "mode is", 2, 7);
    check_fault(header + "1,0,t,,sphere,P,0,0,1,1,0,0\n", "unit vector", 2, 1);
    check_fault(header + "1,0,t,,ballbar,P,0,0,,,\n", "cells", 2, 24);
    check_fault(header + "1,5,t,,ballbar,P,0,0,,,,0\n2,4,t,,ballbar,P,0,0,,,,0\n", "backwards", 3,
                3);
    check_fault(header + "1,5,t,,ballbar,P,0,0,,,,0\n2,5,t,,ballbar,P,0,1,,,,0\n", "same time_s", 3,
                3);
    check_fault(header + "1,5,t,,\"ballbar,P,0,0,,,,0\n", "quote", 2, 8);
    check_fault("index,index\n", "stands twice", 1, 7);
}

TEST_CASE("text reads back to the same values") {
    records::ReadingTable table;
    table.axes = {Axis::X, Axis::C};
    table.optional_columns = {"mode", "spindle_deg", "temperature_c"};
    table.comment["seed"] = "7";
    for (int i = 0; i < 300; ++i) {
        records::Reading row;
        row.index = i;
        row.time_s = 0.1 * i;
        row.test = "map";
        row.device = i % 2 ? records::Device::sphere : records::Device::none;
        row.mode = PositioningMode::tw;
        row.commanded[Axis::X] = 1.0 / (i + 1);
        row.commanded[Axis::C] = rad_from_deg(0.1 * i);
        row.direction_M = {0, -1, 0};
        row.spindle_rad = rad_from_deg(0.3 * i);
        if (i % 3) row.value_mm = -0.001 / (i + 1);
        table.rows.push_back(row);
    }
    const std::string text = records::format_readings(table);
    const records::ReadingTable again = read(text);
    REQUIRE(again.rows.size() == table.rows.size());
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        CHECK(again.rows[i].commanded == table.rows[i].commanded);
        CHECK(again.rows[i].value_mm == table.rows[i].value_mm);
        CHECK(again.rows[i].spindle_rad == table.rows[i].spindle_rad);
        CHECK(again.rows[i].mode == PositioningMode::tw);
    }
    CHECK(records::format_readings(again) == text);
    CHECK(again.comment.at("seed") == "7");
}

namespace {

const std::string instrument_table =
    "# side = X+ C-\n"
    "index,time_s,test,device,feature,x_mm,c_deg,dir_x,dir_y,dir_z,px_mm,py_mm,pz_mm,"
    "velocity_mm_s,velocity_deg_s,sigma_mm,sigma_deg,session,instrument,source,value_mm,value_deg\n"
    "0,0,t,linear,R1,10,0,1,0,0,1,2,3,,,0.001,,mon,,laser.csv:7,0.002,\n"
    "1,1,t,angle,M1,10,30,0,0,1,,,,,,,0.0001,mon,,,,-0.001\n"
    "2,2,t,point,R1,20,30,0,1,0,,,,,,,,tue,T2,,0.5,\n"
    "3,3,t,axis,X,20,30,,,,,,,12.5,,,,tue,,,0.001,\n"
    "4,4,t,axis,C,20,31,,,,,,,,6,,,tue,,,,0.25\n"
    "5,5,\"a \"\"b\"\", c\",angle,M1,20,31,0,0,-1,,,,,,,,tue,,,,\n";

}  // namespace

TEST_CASE("rows of laser, autocollimator, tracker and servo log carry their units") {
    const records::ReadingTable table = read(instrument_table);
    REQUIRE(table.rows.size() == 6);
    CHECK(table.side_before[index_of(Axis::X)] == 1);
    CHECK(table.side_before[index_of(Axis::C)] == -1);
    CHECK(table.side_before[index_of(Axis::Y)] == 0);
    CHECK(table.rows[0].device == records::Device::linear);
    CHECK(*table.rows[0].point_W_mm == Vector3(1, 2, 3));
    CHECK_FALSE(table.rows[1].point_W_mm);
    CHECK(table.rows[0].source == "laser.csv:7");
    CHECK(table.rows[1].angular);
    CHECK(*table.rows[1].value_mm == rad_from_deg(-0.001));
    CHECK(*table.rows[1].sigma_mm == rad_from_deg(0.0001));
    CHECK(table.rows[2].instrument == "T2");
    CHECK(table.rows[2].session == "tue");
    CHECK(*table.rows[3].velocity_mm_s == 12.5);
    CHECK_FALSE(table.rows[3].angular);
    CHECK(*table.rows[4].velocity_mm_s == rad_from_deg(6));
    CHECK(table.rows[5].test == "a \"b\", c");
    CHECK(table.rows[5].angular);  // without a value, too
    CHECK(records::format_readings(table) ==
          records::format_readings(read(records::format_readings(table))));
    CHECK(read(records::format_readings(table)).rows[4].value_mm == table.rows[4].value_mm);
    CHECK(read(records::format_readings(table)).side_before == table.side_before);
}

TEST_CASE("rows that do not fit their device name the place") {
    const std::string names =
        "index,time_s,test,device,feature,x_mm,c_deg,dir_x,dir_y,dir_z,value_mm,value_deg\n";
    check_fault(names + "0,0,t,angle,M,0,0,0,0,1,0.1,\n", "read in degrees", 2, 1);
    check_fault(names + "0,0,t,linear,M,0,0,0,0,1,,0.1\n", "read in mm", 2, 1);
    check_fault(names + "0,0,t,linear,M,0,0,0,0,1,0.1,0.1\n", "mm and degrees", 2, 30);
    check_fault(names + "0,0,t,linear,M,0,0,0,0,2,0.1,\n", "unit vector", 2, 1);
    check_fault(names + "0,0,t,axis,Y,0,0,,,,0.1,\n", "axis of this table, not 'Y'", 2, 1);
    check_fault(names + "0,0,t,axis,C,0,0,,,,0.1,\n", "read in degrees", 2, 1);
    check_fault(names + "0,0,t,laser,X,0,0,,,,0.1,\n", "device is sphere, touch", 2, 7);
    check_fault("# side = X+ Y+\n" + names + "0,0,t,,,0,0,,,,,\n", "no column", 1, 13);
    check_fault("# side = X+ X-\n" + names + "0,0,t,,,0,0,,,,,\n", "twice", 1, 13);
    check_fault("# side = X\n" + names + "0,0,t,,,0,0,,,,,\n", "side reads", 1, 10);
    check_fault("index,time_s,test,device,feature,x_mm,px_mm,value_mm\n", "stand together", 1, 1);
}

TEST_CASE("numbers are strict and short") {
    CHECK(parse_number("+5") == 5.0);
    CHECK(parse_number(" -2.5e-3 ") == -0.0025);
    for (const char* bad : {"", "nan", "inf", "1,5", "5x", "+-5", "--5", "1e999"})
        CHECK_FALSE(parse_number(bad));
    CHECK(shortest(-0.0) == "0");
    CHECK(shortest(0.1) == "0.1");
    CHECK(shortest_degrees(rad_from_deg(58.252591)) == "58.252591");
}

TEST_CASE("ballbar rows: central velocity, one-sided at the ends, sign of travel") {
    const records::ReadingTable table = read(circle(0.2, 1.0, 60));
    const auto samples = records::samples_of(table);
    const auto& rows = table.rows;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::size_t a = i ? i - 1 : 0, b = std::min(i + 1, rows.size() - 1);
        const double v = (rows[b].commanded[Axis::X] - rows[a].commanded[Axis::X]) /
                         (rows[b].time_s - rows[a].time_s);
        CHECK(samples[i].velocity[Axis::X] == Approx(v));
        CHECK(samples[i].travel[index_of(Axis::X)] == (v > 0 ? 1 : -1));
        CHECK(samples[i].travel[index_of(Axis::C)] == 0);
        CHECK(samples[i].velocity[Axis::C] == 0.0);
    }
}

TEST_CASE("a pass that is repeated after another one has ends of its own") {
    const std::string columns = "index,time_s,test,device,feature,x_mm,y_mm,value_mm\n";
    std::string text = columns;
    const char* const tests[] = {"cw", "ccw", "cw"};
    for (int i = 0; i < 15; ++i)
        text += std::to_string(i) + ',' + std::to_string(i) + ',' + tests[i / 5] + ",ballbar,P," +
                std::to_string(3 * i + 100 * (i / 5)) + ",0,0\n";
    const auto samples = records::samples_of(read(text));
    for (const std::size_t i : {0u, 4u, 5u, 9u, 10u, 12u, 14u})
        CHECK(samples[i].velocity[Axis::X] == 3.0);
    CHECK(samples[10].path_mm == 0.0);
}

TEST_CASE("logs that were taken at the same time are passes of their own") {
    // x at 3 mm/s each second, in between y at 2 mm/s; or y in every third second only
    for (const int sparse : {1, 3}) {
        std::string text = "index,time_s,test,device,feature,x_mm,y_mm,value_mm\n";
        for (int i = 0; i < 12; ++i) {
            const std::string at = std::to_string(3 * i) + ',' + std::to_string(2 * i) + ",0\n";
            text += std::to_string(i) + ',' + std::to_string(i) + ",first,axis,X," + at;
            if (i % sparse == 0)
                text += std::to_string(i) + ',' + std::to_string(i) + ",second,axis,Y," + at;
        }
        const records::ReadingTable table = read(text);
        const auto samples = records::samples_of(table);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            CHECK(samples[i].velocity[Axis::X] == Approx(3.0));
            CHECK(samples[i].velocity[Axis::Y] == Approx(2.0));
        }
    }
}

TEST_CASE("settled positions of a log stand on the side from which they came") {
    const auto logged = [](const std::vector<double>& at_mm) {
        records::ReadingTable table;
        table.axes = {Axis::X};
        for (const double x_mm : at_mm) {
            records::Reading row;
            row.time_s = 3.0 * static_cast<double>(table.rows.size());
            row.test = "log";
            row.device = records::Device::axis;
            row.feature = "X";
            row.commanded[Axis::X] = x_mm;
            row.value_mm = 0.0;
            table.rows.push_back(row);
        }
        return records::samples_of(table);
    };
    const std::size_t x = index_of(Axis::X);
    // Up and down in turn: each row is followed by a move back, or by another one.
    const auto stops = logged({0, 30, 30, -30, 20, 30, 20, -10, -10, 10, 0});
    const int side[] = {0, 1, 1, -1, 1, 1, -1, -1, -1, 1, -1};
    for (std::size_t k = 1; k < stops.size(); ++k) {
        INFO(k);
        CHECK(stops[k].travel[x] == side[k]);
        CHECK(stops[k].velocity[Axis::X] == 0.0);
        CHECK(stops[k].acceleration[Axis::X] == 0.0);
    }
    // A dense log turns seldom: its differences are speeds, and a turning point has no side.
    std::vector<double> wave;
    for (int k = 0; k <= 40; ++k) wave.push_back(10.0 * std::cos(2.0 * pi * k / 20.0));
    const auto dense = logged(wave);
    CHECK(dense[5].velocity[Axis::X] < -0.5);
    CHECK(dense[10].travel[x] == 0);
    CHECK(dense[12].travel[x] == 1);
}

TEST_CASE("an exact turning point says nothing about reversal") {
    const auto samples = records::samples_of(read(circle(0.0, 1.0, 40)));
    CHECK(samples[20].travel[index_of(Axis::X)] == 0);  // x = -100
    CHECK(samples[10].travel[index_of(Axis::Y)] == 0);
    CHECK(samples[19].travel[index_of(Axis::X)] == -1);
    CHECK(samples[21].travel[index_of(Axis::X)] == 1);
}

TEST_CASE("distance since reversal counts from the true turning point") {
    for (const double start : {0.0, 0.2, -0.013}) {
        const records::ReadingTable table = read(circle(start, 1.0, 120));
        const auto samples = records::samples_of(table);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const double x = table.rows[i].commanded[Axis::X];
            const double t = start + 2 * pi * static_cast<double>(i) / 120;
            if (std::abs(std::remainder(t, pi)) < 1e-6) continue;
            const double since = samples[i].since_reversal[index_of(Axis::X)];
            if (start >= 0.0)
                CHECK(samples[i].run_up_unknown[index_of(Axis::X)] == (start == 0.0 && t < pi));
            if (start > 0 && t < pi)
                CHECK(since > records::no_reversal_seen);
            else if (t > 0 && t < pi && start == 0.0)
                CHECK(since == Approx(100 - x).margin(1e-3));
            else if (t > pi + 1e-3 && t < 2 * pi)
                CHECK(since == Approx(x + 100).margin(1e-3));
        }
    }
}

TEST_CASE("sphere and touch rows: last non-zero move, device-less rows included") {
    const records::ReadingTable table =
        read(header +
             "0,0,m,,sphere,S,0,5,1,0,0,0\n"  // before the first move of b
             "1,1,m,,,S,10,5,,,,\n"
             "2,2,m,,sphere,S,10,0,1,0,0,0\n"
             "3,3,n,,sphere,S,-7,3,1,0,0,0\n"  // another test: a move too
             "4,4,m,,,S,10,-6,,,,\n"
             "5,5,m,,touch,S,9,2,1,0,0,0\n");
    const auto samples = records::samples_of(table);
    const auto travel = [&](int i, Axis axis) {
        return int(samples[std::size_t(i)].travel[index_of(axis)]);
    };
    CHECK(travel(0, Axis::X) == 0);
    CHECK(samples[0].side_unknown[index_of(Axis::B)]);
    CHECK(samples[1].side_unknown[index_of(Axis::B)]);
    CHECK_FALSE(samples[1].side_unknown[index_of(Axis::X)]);
    CHECK(travel(2, Axis::X) == 1);
    CHECK(travel(2, Axis::B) == -1);
    CHECK(travel(3, Axis::X) == -1);
    CHECK(travel(5, Axis::X) == -1);
    CHECK(travel(5, Axis::B) == 1);
    CHECK(samples[4].since_reversal[index_of(Axis::B)] >
          records::no_reversal_seen);  // n to m: untold
    CHECK(samples[5].velocity[Axis::X] == 0.0);
}

TEST_CASE("the head line tells sides before the first motion of the first session") {
    const std::string columns = "index,time_s,test,device,feature,x_mm,c_deg,session,value_mm\n";
    const auto samples = records::samples_of(read("# side = C-\n" + columns +
                                                  "0,0,m,ballbar,P,0,5,,0\n"
                                                  "1,1,n,ballbar,P,3,5,,0\n"
                                                  "2,2,n,ballbar,P,3,5,late,0\n"
                                                  "3,3,n,ballbar,P,3,6,late,0\n"));
    const auto c = [&](std::size_t i) { return int(samples[i].travel[index_of(Axis::C)]); };
    CHECK(c(0) == -1);
    CHECK(c(1) == -1);  // stands, in another test too
    CHECK(samples[0].side_unknown[index_of(Axis::X)]);
    CHECK(samples[1].travel[index_of(Axis::X)] == 1);
    CHECK(c(2) == 1);  // its own velocity, one-sided
    CHECK(samples[2].side_unknown[index_of(Axis::X)]);
    CHECK(c(3) == 1);
}
