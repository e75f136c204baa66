#include "base/output_files.h"

#include <fcntl.h>
#include <grp.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "base/alarm.h"
#include "base/file_handle.h"
#include "base/read_file.h"
#include "base/waiting.h"

using namespace trunnion;
namespace fs = std::filesystem;

namespace {

struct Folder {
    fs::path path = fs::temp_directory_path() / ("trunnion_out_" + std::to_string(::getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    std::string file(const std::string& name) const { return (path / name).string(); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path / name) << text;
    }
    std::size_t count() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), {}));
    }
};

void put(const std::string& path, const std::string& text) {
    OutputFiles files;
    files.add(path, text);
    files.write();
}

}  // namespace

TEST_CASE("an output replaces a file with its mode and behind its links") {
    const Folder folder;
    folder.write("real.txt", "old");
    fs::permissions(folder.file("real.txt"), fs::perms::owner_all);
    fs::create_symlink("real.txt", folder.file("link.txt"));
    fs::create_symlink("new.txt", folder.file("dangling.txt"));
    put(folder.file("link.txt"), "new");
    put(folder.file("dangling.txt"), "made");
    CHECK(read_file(folder.file("real.txt")) == "new");
    CHECK(read_file(folder.file("new.txt")) == "made");
    CHECK(fs::is_symlink(folder.file("link.txt")));
    CHECK(fs::status(folder.file("real.txt")).permissions() == fs::perms::owner_all);
    CHECK(folder.count() == 4);
}

TEST_CASE("a new file has the mode that the user's mask leaves") {
    const Folder folder;
    const mode_t before = ::umask(027);
    put(folder.file("new.txt"), "x");
    ::umask(before);
    struct stat state {};
    REQUIRE(::stat(folder.file("new.txt").c_str(), &state) == 0);
    CHECK((state.st_mode & 0777) == 0640);
}

TEST_CASE("a replaced file keeps owner and group, another link the old text") {
    const Folder folder;
    folder.write("a.txt", "old");
    REQUIRE(::link(folder.file("a.txt").c_str(), folder.file("b.txt").c_str()) == 0);
    const bool permitted = ::chown(folder.file("a.txt").c_str(), 12345, 23456) == 0;
    CHECK(::chmod(folder.file("a.txt").c_str(), 04755) == 0);
    put(folder.file("a.txt"), "new");
    CHECK(read_file(folder.file("a.txt")) == "new");
    CHECK(read_file(folder.file("b.txt")) == "old");
    struct stat state {};
    REQUIRE(::stat(folder.file("a.txt").c_str(), &state) == 0);
    CHECK(state.st_uid == (permitted ? 12345 : ::getuid()));
    if (permitted) CHECK(state.st_gid == 23456);
    CHECK((state.st_mode & 07777) == 04755);
}

TEST_CASE("an owner that cannot be kept takes the right to run as that owner with it") {
    if (::getuid() != 0) return;  // nobody else can have a file of another owner
    for (const gid_t group : {gid_t{23457}, gid_t{23456}}) {  // another one, and the user's own
        INFO("group " << group);
        const Folder folder;
        folder.write("a.txt", "old");
        CHECK(::chown(folder.path.c_str(), 12345, 23456) == 0);
        CHECK(::chown(folder.file("a.txt").c_str(), 12346, group) == 0);
        CHECK(::chmod(folder.file("a.txt").c_str(), 06777) == 0);
        const pid_t child = ::fork();
        if (child == 0) {
            if (::setgroups(0, nullptr) != 0 || ::setgid(23456) != 0 || ::setuid(12345) != 0)
                ::_exit(2);
            try {
                put(folder.file("a.txt"), "new");
            } catch (const InputError&) {
                ::_exit(1);
            }
            ::_exit(0);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        REQUIRE((WIFEXITED(status) && WEXITSTATUS(status) == 0));
        struct stat state {};
        REQUIRE(::stat(folder.file("a.txt").c_str(), &state) == 0);
        CHECK(state.st_uid == 12345);
        CHECK(state.st_gid == 23456);
        CHECK((state.st_mode & 07777) == 0777);
    }
}

TEST_CASE("folders made for outputs go again when the outputs fail") {
    const Folder folder;
    fs::create_directories(folder.path / "mine");
    const auto write = [&](const std::string& last) {
        OutputFiles files;
        files.add_folder(folder.file("mine/a/b/"));
        files.add(folder.file("mine/a/b/x.txt"), "x");
        files.add(folder.file("mine/a/../c.txt"), "c");
        files.add(last, "y");
        files.write();
    };
    CHECK_THROWS_AS(write("/dev/full"), InputError);
    CHECK(fs::is_empty(folder.path / "mine"));
    write(folder.file("mine/a/b/y.txt"));
    CHECK(read_file(folder.file("mine/a/b/y.txt")) == "y");
    OutputFiles never;
    never.add_folder(folder.file("mine/a"));
    CHECK_THROWS_AS(never.add_folder("/proc/none"), InputError);
}

TEST_CASE("a pipe that nobody reads ends after a time") {
    const Folder folder;
    REQUIRE(::mkfifo(folder.file("pipe").c_str(), 0600) == 0);
    const WaitLimits limits(0.2, {});
    CHECK_THROWS_WITH(put(folder.file("pipe"), "x"), Catch::Contains("nobody reads this pipe"));
    CHECK(folder.count() == 1);
}

TEST_CASE("what is not published leaves the old file and nothing else") {
    const Folder folder;
    folder.write("a.txt", "old");
    folder.write("a.txt.part", "the user's own");
    {
        OutputFiles files;
        files.open(folder.file("a.txt")).append("half");
    }
    CHECK(read_file(folder.file("a.txt")) == "old");
    CHECK(read_file(folder.file("a.txt.part")) == "the user's own");
    CHECK(folder.count() == 2);
}

TEST_CASE("when one output cannot be written, none appears") {
    const Folder folder;
    fs::create_directories(folder.path / "b");
    OutputFiles files;
    files.add(folder.file("a.txt"), "a");
    files.add(folder.file("b"), "b");
    CHECK_THROWS_AS(files.write(), InputError);
    CHECK(folder.count() == 1);
    OutputFiles full;
    full.add(folder.file("a.txt"), "a");
    full.add("/dev/full", "b");
    CHECK_THROWS_AS(full.write(), InputError);
    CHECK(folder.count() == 1);
}

TEST_CASE("a pipe is written to, and stays a pipe") {
    const Folder folder;
    const std::string pipe = folder.file("pipe");
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const FileHandle reader(::open(pipe.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC));
    OutputFiles files;
    files.add(pipe, "text");
    files.write();
    std::array<char, 8> read{};
    CHECK(::read(reader.descriptor(), read.data(), read.size()) == 4);
    CHECK(std::string(read.data()) == "text");
    CHECK(fs::is_fifo(pipe));
    CHECK(folder.count() == 1);
}

TEST_CASE("two that write one path at a time do not mix") {
    const Folder folder;
    OutputFile first(folder.file("a.txt")), second(folder.file("a.txt"));
    first.append("first");
    second.append("second");
    for (OutputFile* file : {&first, &second}) {
        file->complete();
        file->publish();
    }
    CHECK(read_file(folder.file("a.txt")) == "second");
    CHECK(folder.count() == 1);
}

TEST_CASE("more outputs than a process may have open at a time") {
    const Folder folder;
    OutputFiles files;
    for (int k = 0; k < 1500; ++k) files.add(folder.file(std::to_string(k)), std::to_string(k));
    files.write();
    CHECK(folder.count() == 1500);
    CHECK(read_file(folder.file("1499")) == "1499");
}

TEST_CASE("a looping link and a missing folder are refused with the path") {
    const Folder folder;
    fs::create_symlink("b", folder.file("a"));
    fs::create_symlink("a", folder.file("b"));
    CHECK_THROWS_AS(OutputFile(folder.file("a")), InputError);
    CHECK_THROWS_AS(OutputFile("/nowhere/x"), InputError);
    CHECK_THROWS_AS(read_file(folder.file("a")), InputError);
}

TEST_CASE("an output below a file or a missing folder says what stands in the way") {
    const Folder folder;
    put(folder.file("part.nc"), "O1\n");
    const auto says = [](const auto& work) {
        try {
            work();
        } catch (const InputError& error) {
            return error.message;
        }
        return std::string();
    };
    const std::string file = "'" + folder.file("part.nc") + "' is a file, not a folder";
    CHECK(says([&] { OutputFile(folder.file("part.nc/x")); }) == "cannot be written: " + file);
    CHECK(says([&] { OutputFile("/nowhere/at/all"); }) ==
          "cannot be written: there is no folder '/nowhere'");
    for (const char* name : {"part.nc", "part.nc/new"})
        CHECK(says([&] { OutputFiles().add_folder(folder.file(name)); }) ==
              "this folder cannot be made: " + file);
}

// A socket cannot be opened by its name under /proc: the open one is written to.
TEST_CASE("/dev/stdout is the standard output, whatever that is") {
    int ends[2];
    REQUIRE(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0);
    const FileHandle reader(ends[0]);
    std::cout.flush();
    std::fflush(stdout);
    const pid_t id = ::fork();
    if (id == 0) {
        ::dup2(ends[1], STDOUT_FILENO);
        try {
            put("/dev/stdout", "text");
        } catch (const InputError&) {
            ::_exit(1);
        }
        ::_exit(0);
    }
    ::close(ends[1]);
    int state = 0;
    ::waitpid(id, &state, 0);
    CHECK((WIFEXITED(state) && WEXITSTATUS(state) == 0));
    std::array<char, 8> read{};
    CHECK(::read(reader.descriptor(), read.data(), read.size()) == 4);
    CHECK(std::string(read.data()) == "text");
}
