#include "base/read_file.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/alarm.h"
#include "base/file_handle.h"
#include "base/sha256.h"
#include "base/waiting.h"

using namespace trunnion;
namespace fs = std::filesystem;

namespace {

std::string message_of(const std::string& path) {
    try {
        read_file(path);
    } catch (const InputError& error) {
        return error.message;
    }
    return {};
}

}  // namespace

TEST_CASE("files, devices and pipes are read to their end") {
    const std::string path = fs::temp_directory_path() / ("w" + std::to_string(::getpid()));
    const std::string text(300000, 'x');
    std::ofstream(path) << text;
    CHECK(read_file(path) == text);
    fs::remove(path);
    REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    std::thread writer([&] { std::ofstream(path) << text; });
    CHECK(read_file(path) == text);
    writer.join();
    fs::remove(path);
    CHECK(read_file("/dev/null").empty());
    CHECK_FALSE(read_file("/proc/self/status").empty());
}

TEST_CASE("what cannot be read is refused with the reason") {
    CHECK(message_of("/no/such/file") == "cannot be read: No such file or directory");
    CHECK(message_of("/tmp") == "is a folder, not a file");
    CHECK(message_of("/proc/self/mem") == "cannot be read: Input/output error");
}

namespace {

/// A named pipe that is removed again.
struct NamedPipe {
    std::string path = fs::temp_directory_path() / ("pipe" + std::to_string(::getpid()));
    NamedPipe() {
        fs::remove(path);
        REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    }
    ~NamedPipe() { fs::remove(path); }
};

}  // namespace

TEST_CASE("a pipe that nobody writes to ends after a time", "[waiting]") {
    const NamedPipe pipe;
    const WaitLimits limits(0.3, {});
    CHECK_THAT(message_of(pipe.path),
               Catch::StartsWith("cannot be read: nobody writes to this pipe (after 0.3"));
}

TEST_CASE("a writer that comes late or is slow is waited for", "[waiting]") {
    using namespace std::chrono_literals;
    const NamedPipe pipe;
    std::thread writer([&] {
        std::this_thread::sleep_for(200ms);
        std::ofstream out(pipe.path);
        out << "G0" << std::flush;
        std::this_thread::sleep_for(200ms);
        out << "X1" << std::flush;
    });
    CHECK(read_file(pipe.path) == "G0X1");
    writer.join();
}

TEST_CASE("a writer that came and wrote nothing leaves an empty text", "[waiting]") {
    const NamedPipe pipe;
    std::thread writer([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(120));
        std::ofstream out(pipe.path);
    });
    CHECK(read_file(pipe.path).empty());
    writer.join();
}

TEST_CASE("a silent writer ends with the time, a silent device by itself", "[waiting]") {
    const NamedPipe pipe;
    const FileHandle both(::open(pipe.path.c_str(), O_RDWR));
    {
        const WaitLimits limits(0.2, {});
        CHECK_THAT(message_of(pipe.path), Catch::Contains("neither data nor an end (after 0.2"));
    }
    int asked = 0;
    const WaitLimits limits(0.0, [&] { return ++asked == 3; });
    CHECK_THAT(message_of(pipe.path), Catch::Contains("neither data nor an end (interrupted)"));
    asked = 0;
    if (::access("/dev/ptmx", R_OK) == 0)
        CHECK_THAT(message_of("/dev/ptmx"), Catch::Contains("interrupted"));
}

TEST_CASE("an anonymous pipe by its path ends with its last writer", "[waiting]") {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    const FileHandle out(ends[0]);
    const std::string path = "/proc/self/fd/" + std::to_string(ends[0]);
    const bool empty = GENERATE(true, false);
    FileHandle in(ends[1]);
    if (!empty) CHECK(write_all(in.descriptor(), "G0"));
    in.close();
    CHECK(read_file(path) == (empty ? "" : "G0"));
}

TEST_CASE("a socket is refused as such", "[waiting]") {
    sockaddr_un name{};
    name.sun_family = AF_UNIX;
    const std::string path = fs::temp_directory_path() / ("s" + std::to_string(::getpid()));
    path.copy(name.sun_path, sizeof name.sun_path - 1);
    const FileHandle one(::socket(AF_UNIX, SOCK_STREAM, 0));
    REQUIRE(::bind(one.descriptor(), reinterpret_cast<sockaddr*>(&name), sizeof name) == 0);
    CHECK(message_of(path) == "is a socket, not a file");
    fs::remove(path);
}

TEST_CASE("a file that another program has on lease is waited for", "[waiting]") {
    const std::string path = fs::temp_directory_path() / ("lease" + std::to_string(::getpid()));
    std::ofstream(path) << "abc";
    std::signal(SIGIO, SIG_IGN);
    const FileHandle holder(::open(path.c_str(), O_WRONLY));
    if (::fcntl(holder.descriptor(), F_SETLEASE, F_WRLCK) != 0) return;  // no leases here
    {
        const WaitLimits limits(0.2, {});
        CHECK_THAT(message_of(path), Catch::Contains("another program holds it"));
    }
    std::thread release([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
        ::fcntl(holder.descriptor(), F_SETLEASE, F_UNLCK);
    });
    CHECK(read_file(path) == "abc");
    release.join();
    fs::remove(path);
}

TEST_CASE("a file that another program keeps on lease is refused after five seconds", "[waiting]") {
    const std::string path = fs::temp_directory_path() / ("kept" + std::to_string(::getpid()));
    std::ofstream(path) << "abc";
    std::signal(SIGIO, SIG_IGN);
    const FileHandle holder(::open(path.c_str(), O_WRONLY));
    if (::fcntl(holder.descriptor(), F_SETLEASE, F_WRLCK) != 0) return;  // no leases here
    CHECK_THAT(message_of(path), Catch::Contains("another program holds it (after 5"));
    fs::remove(path);
}

TEST_CASE("files are noted while a record lives, and not before or after") {
    const std::string path = fs::temp_directory_path() / ("r" + std::to_string(::getpid()));
    std::ofstream(path) << "abc";
    read_file(path);
    {
        const ReadRecord record;
        CHECK(ReadRecord::files().empty());
        read_file(path);
        read_file(path);
        REQUIRE(ReadRecord::files().size() == 1);
        CHECK(ReadRecord::files()[0].path == path);
        CHECK(ReadRecord::files()[0].sha256 == sha256("abc"));
    }
    CHECK(ReadRecord::files().empty());
    fs::remove(path);
}

TEST_CASE("SHA-256 of the examples of FIPS 180-4") {
    CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
          "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    CHECK(sha256(std::string(1000000, 'a')) ==
          "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}
