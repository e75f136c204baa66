#include "backup/control_files.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "backup/differences.h"
#include "backup/parameter_names.h"
#include "backup/value_text.h"
#include "base/alarm.h"

using namespace trunnion;

namespace {

backup::ControlBackup sample() {
    backup::ControlBackup b{"stick", {}, {}};
    b.files["CNC-PARA.TXT"] =
        "%\n\r\rN00000Q1L1P00000010L2P00000000 \n\r\rN01020Q1A1P88A2P89A3P90\n\r\r"
        "N19680Q1L1P12\n\r\rN19700Q1L1P0.5L2P0.0\n\r\rN19701Q1L1P-1.25\n\r\rN19702Q1L1P3.\n\r\r"
        "N01825 A1 P 3000 A2 P 3000\n\r\rN01411Q1L1I1.0\n\r\r%";
    b.files["EXT_WKZ.TXT"] =
        "%\r\nG90\r\nG10L2P0X0.0Y0.0Z0.0B0.0\r\nG10L2P1X-100.5Y2.0Z-250.125B0.0\r\n"
        "G10L20P3X1.0Y2.0Z3.0B4.0\r\nM02\r\n%";
    b.files["TOOLOFST.TXT"] = "%\nG10G90L10P1R185.676\nG10G90L11P1R-0.01\nG10G90L12P1R3.\n%\n";
    b.files["MACRO.TXT"] =
        "%\nG10L85P500(400C000000000000)\nG10L85P501(FFFFFFFFFFFFFFFF)\nSETVN500[PIVOT]\n#502=7."
        "5\nM02\n%\n";
    return b;
}

}  // namespace

TEST_CASE("a backup fills the stores") {
    offsets::Stores stores;
    stores.variables[501] = 9.0;
    backup::apply_backup(sample(), stores);
    CHECK(stores.parameters.get(0) == 2.0);
    CHECK(stores.parameters.bit(0, 1));
    CHECK(stores.parameters.entry.at(1020).by_axis.at(3) == 90.0);
    CHECK(stores.parameters.entry.at(1825).by_axis.at(2) == 3000.0);
    CHECK(stores.parameters.get(19701) == -1.25);
    CHECK(stores.parameters.get(1411) == 25.4);
    CHECK(stores.work.standard[0][Axis::Z] == -250.125);
    CHECK(stores.work.additional[2][Axis::B] == 4.0);
    CHECK(stores.tools.tool[1].length_mm() == Approx(185.666));
    CHECK(stores.variables.at(500) == 3.5);
    CHECK(stores.variables.count(501) == 0);
    CHECK(stores.variables.at(502) == 7.5);
}

TEST_CASE("an untouched backup keeps its bytes and a change touches only its value") {
    backup::ControlBackup b = sample();
    offsets::Stores stores;
    backup::apply_backup(b, stores);
    backup::update_backup(b, stores);
    CHECK(b.files == sample().files);

    stores.parameters.set(19700, 0.75);
    stores.parameters.set_bit(0, 0, true);
    stores.work.standard[0][Axis::X] = -99.0;
    stores.variables[500] = -1.0;
    backup::update_backup(b, stores);
    offsets::Stores again;
    backup::apply_backup(b, again);
    CHECK(again.parameters.get(19700) == 0.75);
    CHECK(b.files["EXT_WKZ.TXT"].find("X-99.0Y2.0Z-250.125") != std::string::npos);
    const auto differences = backup::diff_backups(sample(), b);
    REQUIRE(differences.size() == 4);
    CHECK(differences[0].name == "0");
    CHECK(differences[0].b == "00000011");
    CHECK(differences[1].name == "19700");
    CHECK(differences[2].name == "G54 X");
    CHECK(differences[3].b == "BFF0000000000000");
}

TEST_CASE("eight bits become a number when the store holds one that no byte can") {
    backup::ControlBackup b{"f", {}, {}};
    b.files["CNC-PARA.TXT"] = "%\nN80Q1P11111110\n%\n";
    offsets::Stores stores;
    stores.parameters.set(80, 1234567890123.0);
    backup::update_backup(b, stores);
    CHECK(b.files["CNC-PARA.TXT"] == "%\nN80Q1P1234567890123\n%\n");
}

TEST_CASE("of a value that is written twice the last counts, and neither text changes by itself") {
    backup::ControlBackup b{"f", {}, {}};
    b.files["CNC-PARA.TXT"] = "%\nN80Q1P11111110P5\nN19700Q1L1P1.0\nN19700Q1L1P2.0\n%\n";
    b.files["MACRO.TXT"] = "%\n#500=1.0\n#500=2.0\n%\n";
    b.files["EXT_WKZ.TXT"] = "%\nG10L2P1X1.0\nG10L2P1X3.0\n%\n";
    const auto before = b.files;
    offsets::Stores stores;
    backup::apply_backup(b, stores);
    CHECK(stores.parameters.get(19700) == 2.0);
    CHECK(backup::update_backup(b, stores).empty());
    CHECK(b.files == before);
    CHECK(backup::update_backup(b, offsets::Stores()).at("EXT_WKZ.TXT") == 2);
    b.files = before;
    stores.variables[500] = 7.0;
    backup::update_backup(b, stores);
    CHECK(b.files["MACRO.TXT"] == "%\n#500=7.0\n#500=7.0\n%\n");
}

TEST_CASE("a variable that became vacant is written so, or the form that cannot is named") {
    backup::ControlBackup b{"f", {}, {}};
    b.files["MACRO.TXT"] = "%\n#500=1.0\nG10L85P501(400C000000000000)\n%\n";
    backup::update_backup(b, offsets::Stores());
    CHECK(b.files["MACRO.TXT"] == "%\n#500=#0\nG10L85P501(FFFFFFFFFFFFFFFF)\n%\n");
    offsets::Stores stores;
    stores.variables[500] = 4.0;
    backup::ControlBackup again = b;
    backup::apply_backup(again, stores);
    CHECK(stores.variables.empty());
    stores.variables[500] = 4.5;
    backup::update_backup(again, stores);
    CHECK(again.files["MACRO.TXT"] == "%\n#500=4.5\nG10L85P501(FFFFFFFFFFFFFFFF)\n%\n");
    b.files["MACRO.TXT"] = "%\nG10L85P500R1.0\n%\n";
    CHECK_THROWS_AS(backup::update_backup(b, offsets::Stores()), InputError);
}

TEST_CASE("a changed value is written in the digits of a control, whatever its size") {
    struct Row {
        const char* before;
        double value;
        const char* after;
    };
    for (const Row& row :
         {Row{"P1.000", 0.00001, "P0.00001"}, Row{"P5", 1e17, "P100000000000000000"},
          Row{"P-.5", -0.25, "P-0.25"}, Row{"P+1.", 3.0, "P3."},
          Row{"P1.0", 1e-7 / 3.0, "P0.000000033333333333333334"},
          Row{"I1.000", 25.4 * 1.234, "I1.234"}, Row{"I1.0", 0.254e-5, "I0.0000001"}}) {
        CAPTURE(row.before, row.value);
        backup::ControlBackup b{"f", {}, {}};
        b.files["CNC-PARA.TXT"] = std::string("%\nN19700Q1L1") + row.before + "\n%\n";
        offsets::Stores stores;
        stores.parameters.set(19700, row.value);
        backup::update_backup(b, stores);
        CHECK(b.files["CNC-PARA.TXT"] == std::string("%\nN19700Q1L1") + row.after + "\n%\n");
        offsets::Stores again;
        backup::apply_backup(b, again);
        CHECK(again.parameters.get(19700) == Approx(row.value).epsilon(1e-15));
    }
}

TEST_CASE("offsets of a backup have the unit in which the control would read them") {
    backup::ControlBackup b{"f", {}, {}};
    b.files["EXT_WKZ.TXT"] = "%\nG90\nG10L2P1X1.0C30.0\nM02\n%\n";
    b.files["TOOLOFST.TXT"] = "%\nG10G90L10P1R2.0\n%\n";
    b.files["MACRO.TXT"] = "%\nG10L85P500R3.0\n%\n";
    const auto loaded = [&] {
        offsets::Stores stores;
        backup::apply_backup(b, stores);
        CHECK(stores.work.standard[0][Axis::C] == 30.0);
        CHECK(stores.variables.at(500) == 3.0);
        return std::pair(stores.work.standard[0][Axis::X], stores.tools.tool[1].length_mm());
    };
    CHECK(loaded() == std::pair(1.0, 2.0));
    b.files["CNC-PARA.TXT"] = "%\nN00000Q1L1P00000100L2P00000000\n%\n";  // 0000#2: input in inch
    CHECK(loaded() == std::pair(25.4, 50.8));
    offsets::Stores stores;
    backup::apply_backup(b, stores);
    CHECK(backup::update_backup(b, stores).empty());
    stores.work.standard[0][Axis::X] = 25.4 * 1.5;
    backup::update_backup(b, stores);
    CHECK(b.files["EXT_WKZ.TXT"] == "%\nG90\nG10L2P1X1.5C30.0\nM02\n%\n");
    stores.parameters.set_bit(0, 2, false);
    CHECK_THROWS_AS(backup::update_backup(b, stores), InputError);
    b.files["EXT_WKZ.TXT"] = "%\nG21\nG90G10L2P1X1.0C30.0\nM02\n%\n";
    CHECK(loaded() == std::pair(1.0, 50.8));
    b.files.erase("CNC-PARA.TXT");
    b.files["EXT_WKZ.TXT"] = "%\nG20\nG10L2P1X1.0C30.0\nM02\n%\n";
    CHECK(loaded() == std::pair(25.4, 2.0));
    for (const char* line :
         {"G10L2P1X1000", "G90G10L2P1X1000", "G91G10L2P1X1.", "G10G91L2P1X1.", "G10L10P1R1000"}) {
        CAPTURE(line);
        b.files["EXT_WKZ.TXT"] = std::string("%\n") + line + "\n%\n";
        CHECK_THROWS_AS(backup::list_values(b), InputError);
    }
    b.files["EXT_WKZ.TXT"] = "%\nG10L2P1X0Y0\n%\n";
    CHECK(backup::list_values(b).size() == 4);
}

TEST_CASE("a value that acts on nothing here is not called obeyed") {
    backup::ControlBackup b{"f", {}, {}};
    b.files["TOOLOFST.TXT"] = "%\nG10L10P999R1.0\nG10L10P2000R1.0\n%\n";
    b.files["EXT_WKZ.TXT"] = "%\nG10L2P6X1.0\nG10L2P7X1.0\nG10L20P300X1.0\nG10L20P301X1.0\n%\n";
    b.files["CNC-PARA.TXT"] =
        "%\nN01825A1P3000\nN19703P1.0\nN19704L1P2.0L2P3.0\nN03772S1P8000S2P9000\nN01320A4P1.0\n%\n";
    std::string found;
    for (const backup::BackupValue& v : backup::list_values(b))
        found += backup::text_of(backup::standing_of_value(v))[0];
    CHECK(found == "kookokooioioi");
    offsets::Stores stores;
    backup::apply_backup(b, stores);
    CHECK(stores.parameters.get(19704) == 2.0);
    CHECK(stores.parameters.get(3772) == 8000.0);
    CHECK(stores.parameters.entry.at(1320).by_axis.at(4) == 1.0);
    const auto before = b.files;
    CHECK(backup::update_backup(b, stores).empty());
    CHECK(b.files == before);
}

TEST_CASE("a comment in front of a record, or CR alone as line end, hides no value") {
    backup::ControlBackup b{"f", {}, {}};
    b.files["EXT_WKZ.TXT"] = "%\n(NOTE)(TWO) G10L2P1X1.0\n(ALONE)\n(OPEN\n/G10L2P1X2.0\n%\n";
    REQUIRE(backup::list_values(b).size() == 1);
    CHECK(backup::list_values(b)[0].line == 2);
    b.files["EXT_WKZ.TXT"] = "%\rG90\rG10L2P1X1.0\rG10L2P2X2.0\rM02\r%";
    REQUIRE(backup::list_values(b).size() == 2);
    CHECK(backup::list_values(b)[1].line == 4);
}

TEST_CASE("two files whose names differ only in case are refused, for one would be lost") {
    const auto folder = std::filesystem::temp_directory_path() / "trunnion_backup_case";
    std::filesystem::create_directories(folder);
    for (const char* name : {"MACRO.TXT", "macro.txt"})
        std::ofstream(folder / name) << "%\n#500=1.0\n%\n";
    CHECK_THROWS_AS(backup::read_backup(folder.string()), InputError);
    std::filesystem::remove_all(folder);
}

static void write_backup(const backup::ControlBackup& backup, const std::string& folder) {
    OutputFiles files;
    backup::add_backup_files(backup, folder, files);
    files.write();
}

TEST_CASE("files on disk round-trip byte for byte") {
    const auto folder = std::filesystem::temp_directory_path() / "trunnion_backup_test";
    std::filesystem::remove_all(folder);
    write_backup(sample(), folder.string());
    CHECK(backup::read_backup(folder.string()).files == sample().files);
    // A folder that is not there yet, named from where one works.
    const auto here = std::filesystem::current_path();
    std::filesystem::current_path(folder.parent_path());
    std::filesystem::remove_all("trunnion_backup_copy");
    write_backup(backup::read_backup("trunnion_backup_test"), "trunnion_backup_copy/new");
    CHECK(backup::read_backup("trunnion_backup_copy/new").files == sample().files);
    CHECK_THROWS_AS(write_backup(backup::read_backup("trunnion_backup_test"),
                                 "trunnion_backup_test/../trunnion_backup_test/x"),
                    InputError);
    std::filesystem::remove_all("trunnion_backup_copy");
    std::filesystem::current_path(here);
    std::filesystem::remove_all(folder);
    CHECK_THROWS_AS(backup::read_backup(folder.string()), InputError);
}

TEST_CASE("bad backup lines are refused with their place") {
    backup::ControlBackup b = sample();
    b.files["CNC-PARA.TXT"] = "%\nN19700Q1L1X0.0\n";
    try {
        backup::list_values(b);
        FAIL("accepted");
    } catch (const InputError& e) {
        CHECK(e.where.line == 2);
        CHECK(e.where.column == 11);
    }
    b.files["CNC-PARA.TXT"] = "%\nN19680Q1L1P12\n%\n";
    offsets::Stores stores;
    CHECK_THROWS_AS(backup::apply_backup(b, stores), InputError);
    b.files["CNC-PARA.TXT"] = "%\n<<<<<<< HEAD\n%\n";
    CHECK_THROWS_AS(backup::list_values(b), InputError);
    for (const char* number : {"1.2.3", "--1", "1-", "."}) {
        INFO(number);
        b.files["CNC-PARA.TXT"] = std::string("%\nN19700Q1L1P") + number + "\n%\n";
        CHECK_THROWS_AS(backup::list_values(b), InputError);
    }
    for (const char* line : {"N19700T70097020P1", "N19700A1000P1", "N999999999P1"}) {
        INFO(line);
        b.files["CNC-PARA.TXT"] = std::string("%\n") + line + "\n%\n";
        CHECK_THROWS_AS(backup::list_values(b), InputError);
    }
    b.files["CNC-PARA.TXT"] = "%\nN19700A999P1\n%\n";
    CHECK_NOTHROW(backup::list_values(b));
    backup::ControlBackup variables;
    const auto read = [&](const std::string& digits) {
        variables.files["MACRO.TXT"] = "%\nG10L85P500(" + digits + ")\n%\n";
        return backup::list_values(variables).size();
    };
    CHECK(read("3FF0000000000000") == 1);
    CHECK(read("FFFFFFFFFFFFFFFF") == 1);
    CHECK_THROWS_AS(read("7FF0000000000000"), InputError);  // infinite
    CHECK_THROWS_AS(read("3FF000000000000G"), InputError);
}
