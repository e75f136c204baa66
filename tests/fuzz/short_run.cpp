// The short version of a fuzz target, without libFuzzer: every file of a corpus, then seeded
// changes of them. short_run CORPUS CHANGES. A broken law or a crash ends it by a signal.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "base/random.h"
#include "fuzz/target.h"

namespace {

using trunnion::SeededNoise;

std::vector<std::string> corpus_of(const std::string& folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<std::string> texts;
    for (const auto& path : paths) {
        std::ostringstream text;
        text << std::ifstream(path, std::ios::binary).rdbuf();
        texts.push_back(text.str());
    }
    return texts;
}

std::size_t below(SeededNoise& random, std::size_t end) {
    return end == 0 ? 0 : random.bits() % end;
}

/// Words that turn up in all the languages: numbers at limits, brackets, separators.
const std::vector<std::string> words = {"0",     "-1",  "1e308", "nan",     "99999999", "#",   "[",
                                        "]",     "=",   "\"",    ",",       ";",        "\n",  "%",
                                        "G43.4", "M99", ".",     "X-0.001", "inf",      "\r\n"};

std::string changed(std::string text, const std::vector<std::string>& corpus, SeededNoise& random) {
    const std::size_t changes = 1 + below(random, 4);
    for (std::size_t i = 0; i < changes; ++i) {
        const std::size_t at = below(random, text.size() + 1);
        const std::size_t size = below(random, std::min<std::size_t>(20, text.size() - at + 1));
        switch (below(random, 5)) {
            case 0: text.erase(at, size); break;
            case 1: text.insert(at, words[below(random, words.size())]); break;
            case 2: text.insert(at, text.substr(at, size)); break;
            case 3:
                if (at < text.size()) text[at] = static_cast<char>(below(random, 256));
                break;
            default: {
                const std::string& other = corpus[below(random, corpus.size())];
                text.replace(at, size, other.substr(below(random, other.size() + 1), 40));
            }
        }
    }
    return text;
}

void run(const std::string& text) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    const std::vector<std::string> corpus = corpus_of(argv[1]);
    if (corpus.empty()) {
        std::cerr << "short_run: no file in " << argv[1] << '\n';
        return 2;
    }
    for (const std::string& text : corpus) {
        const int before = trunnion::fuzz::accepted;
        run(text);
        trunnion::fuzz::law(trunnion::fuzz::accepted > before, "a file of the corpus is accepted");
    }
    const int whole = trunnion::fuzz::accepted;
    SeededNoise random(1);
    const int changes = std::atoi(argv[2]);
    for (int i = 0; i < changes; ++i)
        run(changed(corpus[below(random, corpus.size())], corpus, random));
    std::cout << corpus.size() << " files, " << changes << " changes of them, "
              << trunnion::fuzz::accepted - whole << " accepted: every law holds\n";
}
