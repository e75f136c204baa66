#include "interpreter/program_folders.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "base/alarm.h"

using namespace trunnion;
namespace fs = std::filesystem;

namespace {

struct Folder {
    fs::path path = fs::temp_directory_path() / ("trunnion_programs_" + std::to_string(::getpid()));
    Folder() {
        fs::create_directories(path / "b");
        write("O0012.nc", "%\nO0012\nM30\n%\n");
        write("34.NC", "M30\n");
        write("many.txt", "O100 (A)\nM99\nO101\nM99\n:102\nM99\n(O103)\n");
        write("picture.png", "O104\n");
        write("b/O12", "other\n");
        write("named part.nc", "G0\n");
        write("empty.nc", "");
    }
    ~Folder() { fs::remove_all(path); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path / name) << text;
    }
};

}  // namespace

TEST_CASE("the user's folders are searched whole before the shipped ones") {
    const Folder folder;
    folder.write("b/O100.nc", "O100 (OURS)\nM99\n");
    folder.write("b/O777.nc", "O777\nM99\n");
    interpreter::ProgramFolders programs({folder.path.string()}, {(folder.path / "b").string()});
    CHECK_THAT(programs.find(100)->name, Catch::EndsWith("many.txt"));  // by content before names
    CHECK(programs.announcements().empty());
    CHECK(programs.find(777));
    CHECK(programs.find(777));
    REQUIRE(programs.announcements().size() == 1);
    CHECK_THAT(programs.announcements()[0], Catch::StartsWith("O777 is a shipped program ("));
}

TEST_CASE("files with the endings of other controls and systems are read, too") {
    const Folder folder;
    const char* const endings[] = {"hnc", "FNC", "dnc",   "spf", "sub",
                                   "mac", "arc", "gcode", "001", "PIM"};
    int number = 7100;
    for (const char* const ending : endings)
        folder.write(std::string("part.") + ending, "O" + std::to_string(number++) + "\nM99\n");
    folder.write("O7100.1", "O7201 (OLD)\nM99\n");
    folder.write("part.pdf", "O7200\nM99\n");
    interpreter::ProgramFolders programs({folder.path.string()}, {});
    for (int n = 7100; n < number; ++n) CHECK(programs.find(n));
    CHECK_FALSE(programs.find(7200));
    CHECK_THAT(programs.find(7100)->name, Catch::EndsWith("part.hnc"));
    CHECK(programs.find(7201));
}

TEST_CASE("programs of a file that a control punched: LF CR CR ends its lines") {
    const Folder folder;
    folder.write("ALL-FLDR.TXT",
                 "%\n\r\r&F=/MTB1/\n\r\rO9001(TOOL)\n\r\rM99\n\r\rO9810\n\r\rM99\n\r\r%");
    interpreter::ProgramFolders programs({folder.path.string()});
    CHECK(programs.find(9001));
    CHECK(programs.find(9810));
    CHECK_FALSE(programs.find(9811));
}

TEST_CASE("a file with the number 0 is found by its name") {
    const Folder folder;
    folder.write("O0000.nc", "M99\n");
    interpreter::ProgramFolders programs({folder.path.string()});
    REQUIRE(programs.find(0));
    CHECK_THAT(programs.find(0)->name, Catch::EndsWith("O0000.nc"));
}

TEST_CASE("a file with zero bytes is no program, whatever its lines begin with") {
    const Folder folder;
    folder.write("tool", std::string("\x7f"
                                     "ELF\0\0\nO555\nM99\n",
                                     16));
    interpreter::ProgramFolders programs({folder.path.string()});
    CHECK_FALSE(programs.find(555));
    CHECK(programs.find(101));
}

TEST_CASE("programs are found by file name, then by what the files hold") {
    const Folder folder;
    interpreter::ProgramFolders programs({folder.path.string(), (folder.path / "b").string()});
    REQUIRE(programs.find(12));
    CHECK_THAT(programs.find(12)->name, Catch::EndsWith("O0012.nc"));
    CHECK(programs.find(34)->text == "M30\n");
    for (const int n : {100, 101, 102})
        CHECK_THAT(programs.find(n)->name, Catch::EndsWith("many.txt"));
    for (const int n : {103, 104, 999}) CHECK_FALSE(programs.find(n));
    CHECK(programs.find("named part"));
    CHECK(programs.find("NAMED PART.NC"));
    CHECK_FALSE(programs.find("nothing"));
    CHECK(programs.find("empty")->text.empty());
    programs.add_file({"main.nc", "O12\nM99\n", nullptr});
    CHECK(programs.find(12)->name == "main.nc");
    CHECK_THROWS_AS(interpreter::ProgramFolders({"/no/such/folder"}), InputError);
    CHECK_THROWS_AS(interpreter::read_program("/no/such/file"), InputError);
    CHECK_THROWS_AS(interpreter::read_program(folder.path.string()), InputError);
}

TEST_CASE("file names that look like numbers, and a name that only the shipped folder knows") {
    const Folder folder;
    folder.write("O-5.nc", "M99\n");
    folder.write("O99999999999.nc", "M99\n");
    folder.write("O5A.nc", "M99\n");
    folder.write("O.nc", "M99\n");
    folder.write("b/SHIPPED.nc", "<NAME>\nM99\nO\nM99\n");
    interpreter::ProgramFolders programs({(folder.path / "b").string()}, {folder.path.string()});
    for (const int n : {-5, 5, 0, 999}) CHECK_FALSE(programs.find(n));
    CHECK_THAT(programs.find("shipped")->name, Catch::EndsWith("SHIPPED.nc"));
    CHECK(programs.announcements().empty());
    CHECK(programs.find("Named Part"));
    CHECK(programs.find("named part"));
    CHECK(programs.announcements().size() == 2);
    CHECK(programs.used().size() == 2);
    programs.add_file({"main.nc", "O5\n", nullptr});
    CHECK(programs.used().size() == 3);
}

TEST_CASE("a main program with nothing in it is refused") {
    const Folder folder;
    folder.write("blank.nc", "%\r\n \t\n%\n");
    CHECK_THROWS_AS(interpreter::read_main_program((folder.path / "blank.nc").string()),
                    InputError);
    CHECK_THROWS_AS(interpreter::read_main_program((folder.path / "empty.nc").string()),
                    InputError);
    CHECK(interpreter::read_main_program((folder.path / "34.NC").string()).text == "M30\n");
}

TEST_CASE("subfolders are searched behind the user's folders, three deep, with a line") {
    const Folder folder;
    for (const char* sub : {"b/c/d/e", "b/.git", "ours"}) fs::create_directories(folder.path / sub);
    folder.write("b/stuff.txt", "%\nO8001(MINE)\nM99\nO100\n%\n");
    folder.write("b/c/o8002.NC", "M99\n");
    folder.write("b/c/two.txt", "O8001\nM99\n<BORE>\nM99\n");
    folder.write("b/c/d/three.txt", "O8003\nM99\n");
    folder.write("b/c/d/e/four.txt", "O8004\nM99\n");
    folder.write("b/.git/five.txt", "O8005\nM99\n");
    folder.write("ours/O8006.nc", "O8006\nM99\n");
    fs::create_directory_symlink(folder.path / "b/c", folder.path / "a_link");
    interpreter::ProgramFolders programs({folder.path.string()}, {(folder.path / "ours").string()});
    CHECK_THAT(programs.find(100)->name, Catch::EndsWith("many.txt"));
    CHECK(programs.announcements().empty());
    CHECK_THAT(programs.find(8001)->name, Catch::EndsWith("/b/stuff.txt"));
    REQUIRE(programs.announcements().size() == 1);
    CHECK_THAT(programs.announcements()[0],
               Catch::StartsWith("O8001 is taken from a subfolder (") &&
                   Catch::Contains("b/stuff.txt); it is also in ") &&
                   Catch::EndsWith("b/c/two.txt"));
    CHECK_THAT(programs.find(8002)->name, Catch::EndsWith("/b/c/o8002.NC"));
    CHECK_THAT(programs.find(8003)->name, Catch::EndsWith("three.txt"));
    CHECK_THAT(programs.find("BORE")->name, Catch::EndsWith("two.txt"));
    for (const int n : {8004, 8005}) CHECK_FALSE(programs.find(n));
    programs.find(8006);
    CHECK_THAT(programs.announcements().back(), Catch::StartsWith("O8006 is a shipped program"));
}

TEST_CASE("too many files in subfolders are left out, which is said") {
    const Folder folder;
    fs::create_directories(folder.path / "full");
    fs::create_directories(folder.path / "late");
    for (int i = 0; i < 5001; ++i) folder.write("full/f" + std::to_string(i) + ".nc", "M99\n");
    folder.write("late/O8009.nc", "O8009\nM99\n");
    interpreter::ProgramFolders programs({folder.path.string()});
    CHECK_FALSE(programs.find(8009));
    REQUIRE(programs.announcements().size() == 1);
    CHECK_THAT(programs.announcements()[0],
               Catch::StartsWith("the subfolders hold too many files: from ") &&
                   Catch::Contains("full/f"));
    CHECK(programs.find(100));
}

TEST_CASE("names in every spelling, and names in angle brackets") {
    const Folder folder;
    const char* const names[] = {"O7001",      "o7002.nc", "7003.NC",    "O7004.TXT",
                                 "o07005.Tap", "<O7006>",  "<o7007>.txt"};
    for (const char* name : names) folder.write(name, "G0X1.\nM99\n");
    folder.write("card.txt", "%\n<O7008>(PART)\nM99\n<7009>\nM99\n<DRILL>\nM99\n%\n");
    interpreter::ProgramFolders programs({folder.path.string()});
    for (int n = 7001; n <= 7008; ++n) {
        INFO(n);
        CHECK(programs.find(n));
    }
    CHECK_FALSE(programs.find(7009));  // a name, no number
    CHECK_FALSE(programs.find(0));
    for (const char* name : {"DRILL", "7009", "O7008"}) {
        REQUIRE(programs.find(name));
        CHECK_THAT(programs.find(name)->name, Catch::EndsWith("card.txt"));
    }
    CHECK(programs.announcements().empty());
}

TEST_CASE("a file that is named O8001 and holds another number is said to") {
    const Folder folder;
    folder.write("O7011.nc", "%\nO7012\nM99\n%\n");
    interpreter::ProgramFolders programs({folder.path.string()});
    CHECK_THAT(programs.find(7011)->name, Catch::EndsWith("O7011.nc"));
    REQUIRE(programs.announcements().size() == 1);
    CHECK_THAT(programs.announcements()[0],
               Catch::EndsWith("O7011.nc by the file's name: it holds O7012"));
    CHECK(programs.find(7012));
    CHECK(programs.announcements().size() == 1);
}

TEST_CASE("the zero bytes before and behind a text punched on tape are no part of it") {
    const Folder folder;
    folder.write("tape.nc", std::string(200, '\0') + "%\nO7020\nM99\n%\n" + std::string(90, '\0'));
    folder.write("blank.nc", std::string(50, '\0') + "%\n%\n");
    interpreter::ProgramFolders programs({folder.path.string()});
    REQUIRE(programs.find(7020));
    CHECK(programs.find(7020)->text == "%\nO7020\nM99\n%\n");
    CHECK_THROWS_AS(interpreter::read_main_program((folder.path / "blank.nc").string()),
                    InputError);
}
