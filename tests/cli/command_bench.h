// A folder of its own in which a test runs the program as a user would.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

struct CommandBench {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("trunnion_cli_" + std::to_string(::getpid()));
    CommandBench() { std::filesystem::create_directories(path); }
    ~CommandBench() { std::filesystem::remove_all(path); }
    CommandBench(const CommandBench&) = delete;
    CommandBench& operator=(const CommandBench&) = delete;

    std::string file(const std::string& name) const { return (path / name).string(); }
    /// The file's whole path.
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path / name) << text;
        return file(name);
    }
    std::string read(const std::string& name) const {
        std::ostringstream text;
        text << std::ifstream(path / name).rdbuf();
        return text.str();
    }
    /// Exit code; stdout in out.txt, stderr in err.txt.
    int trunnion(const std::string& words) const {
        return WEXITSTATUS(std::system(command(words).c_str()));
    }
    /// The same when it is asked to end after two seconds. A shell's job in the background ignores
    /// Ctrl-C (SIGINT); SIGTERM does the same.
    int interrupted(const std::string& words) const {
        const std::string job = command(words) + " & job=$!; sleep 2; kill -TERM $job; wait $job";
        return WEXITSTATUS(std::system(job.c_str()));
    }

  private:
    std::string command(const std::string& words) const {
        return std::string(TRUNNION_BINARY_DIR) + "/bin/trunnion " + words + " >" +
               file("out.txt") + " 2>" + file("err.txt");
    }
};
