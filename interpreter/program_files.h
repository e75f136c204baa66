// The program texts in use, the programs in them, and the positions of N numbers and ENDs.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "interpreter/program_source.h"

namespace trunnion::interpreter {

/// The start of a block.
struct TextPlace {
    std::uint64_t byte = 0;
    int line = 1;
};

struct Numbered {
    int number = 0;
    int line = 0;
    std::uint64_t byte = 0;
};

/// Where a folder of the control begins in a file with all its programs: `&F=/USER/PATH1/`.
struct FolderStart {
    std::uint64_t byte = 0;
    std::string name;  ///< "/USER/PATH1/", in upper case
};

/// One file; its lists are built at the first call that needs them.
struct ProgramFile {
    int id = 0;
    ProgramText text;
    bool listed = false;
    std::vector<Numbered> programs;    ///< by O number; equal numbers as in the text
    std::vector<FolderStart> folders;  ///< as in the text; empty: no folders
};

/// One program: from its O number (or its first block) to the next program or the end of record.
struct Section {
    ProgramFile* file = nullptr;
    TextPlace begin;
    int o_number = 0;
    std::uint64_t read_to = 0;  ///< the text before this was executed already
    int first_block = -1;       ///< in the runner's cache
    bool indexed = false;
    bool index_too_large = false;  ///< too many N numbers to index: the text is searched each time
    std::vector<Numbered> index;   ///< N numbers, sorted by number, then position
};

class ProgramFiles {
  public:
    explicit ProgramFiles(ProgramSource& source) : source_(source) {}

    /// The first program of a text.
    Section& open(const ProgramText& text);
    /// Program O`number`: searched in the file of `near`, in the first opened file, then in the
    /// source. Where a file has the number in several folders: the folder of `near`, then the
    /// order of docs/control.md.
    Section* find(int number, const Section* near);
    /// Searched in the source only (M198).
    Section* find_outside(int number);
    /// The program `<name>`: searched in the file of `near`, then in the source.
    Section* find(std::string_view name, const Section& near);

    /// GOTO: the next N`number` after `after`, up to the end of the program, then from its start.
    std::optional<TextPlace> find_sequence(Section& section, int number, std::uint64_t after);
    /// Position after the END `number` that closes the DO whose block ends at `from`; empty if
    /// none.
    std::optional<TextPlace> find_loop_end(const Section& section, TextPlace from, int number);
    /// Position after the ENDIF (or ELSE, if wanted) of the branch whose block ends at `from`;
    /// empty if none.
    std::optional<TextPlace> find_branch_end(const Section& section, TextPlace from, bool to_else);

    void forget_first_blocks();
    /// Number of lines passed by all searches so far.
    std::uint64_t lines_searched() const { return lines_searched_; }

  private:
    ProgramFile& add(const ProgramText& text);
    Section& section_at(ProgramFile& file, TextPlace place, int o_number);
    void list(ProgramFile& file);
    Section* find_in(ProgramFile& file, int number, const Section* near);
    Section* find_in(ProgramFile& file, std::string_view name, const Section* near);
    void build_index(Section& section);
    std::optional<TextPlace> search_text(const Section& section, int number, std::uint64_t after);

    ProgramSource& source_;
    std::vector<std::unique_ptr<ProgramFile>> files_;
    std::vector<std::unique_ptr<Section>> sections_;
    std::uint64_t lines_searched_ = 0;
    /// The file and folder from which a program is called; -1: none.
    using Caller = std::pair<int, int>;
    Caller caller_of(const Section* near);
    /// Numbers and names that were looked for, found or not.
    std::map<std::pair<Caller, std::string>, Section*> named_;
    std::map<std::pair<Caller, int>, Section*> found_;
};

}  // namespace trunnion::interpreter
