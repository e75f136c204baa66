#include "base/read_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/alarm.h"
#include "base/sha256.h"

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
