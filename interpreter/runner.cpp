#include "interpreter/runner.h"

#include <algorithm>

#include "interpreter/alarms.h"

namespace trunnion::interpreter {

Interpreter::State::State(ProgramSource& source, InterpreterOptions given, SystemVariables& system,
                          Print print_line)
    : options(std::move(given)),
      files(source),
      memory(system, options.dialect.has_98000),
      print(std::move(print_line)) {
    rules.signed_angles = options.asin_0_to_minus_90;
    rules.increments_per_unit = powers_of_ten[static_cast<std::size_t>(options.increment_digits)];
    parse.dialect = options.dialect;
    parse.names = &names;
    for (std::size_t i = 1; i < parse.skip.size() && i < options.skip_switches.size(); ++i)
        parse.skip[i] = options.skip_switches[i];
    for (const double code : {10.0, 65.0, 66.0, 66.1, 67.0})
        special.g[static_cast<std::size_t>(code * 10.0 + 0.5)] = true;
    for (const std::size_t code : {98u, 99u, 198u}) special.m[code] = true;
    for (const auto& [code, call] : options.calls.g)
        if (code >= 0 && code < 10000) special.g[static_cast<std::size_t>(code)] = true;
    for (const auto& [code, call] : options.calls.m) {
        if (code >= 0 && code < 1000) special.m[static_cast<std::size_t>(code)] = true;
        special.large_m = special.large_m || code >= 1000;
    }
    special.t = options.calls.t_calls_9000;
    const auto depth = static_cast<std::size_t>(options.dialect.macro_call_levels);
    levels.resize(depth + 1);
    repeated.resize(depth + 1);
    modals.resize(depth + 1);
    for (Locals& level : levels) level.fill(vacant);
    memory.locals = &levels[0];
    frames.reserve(static_cast<std::size_t>(options.dialect.total_levels) + 2);
}

void Interpreter::State::start(Section& section) {
    frames.clear();
    Frame main;
    main.section = &section;
    main.locals = memory.locals = &levels[0];
    main.start = at = {section.begin.byte, section.begin.line, section.first_block};
    frames.push_back(main);
    current = at;
    link_from = -1;
    modal_count = 0;
    pending = {};
    moved = ended = limit = false;
    main_end = MainEnd::other;
}

namespace {

/// A program that jumps between empty lines executes few blocks but takes long. The block limit
/// therefore also limits the lines: so many for each block, plus a constant.
constexpr std::uint64_t lines_of_a_block = 64, lines_without_blocks = 1000000;

bool is_at_limit(std::uint64_t blocks, std::uint64_t passed, std::uint64_t most) {
    if (most == 0) return false;
    if (most > ~std::uint64_t{0} / 2 / lines_of_a_block) return blocks >= most;
    return blocks >= most || passed >= lines_of_a_block * most + lines_without_blocks;
}

}  // namespace

bool Interpreter::State::look_up_limits() {
    const std::uint64_t passed = lines + files.lines_searched();
    constexpr std::uint64_t stride = 4096;
    limit = is_at_limit(executed, passed, options.max_blocks) ||
            (options.go_on && !options.go_on(executed));
    ended = limit;  // asked only while it runs
    const std::uint64_t blocks_left =
        options.max_blocks > executed ? options.max_blocks - executed : stride;
    look_up_at = passed + std::min(stride, blocks_left);
    return limit;
}

/// Runs blocks until one has words for the control.
const BlockWords* Interpreter::State::step() {
    if (pending.kind != Pending::Kind::none) perform_pending();
    if (moved) call_after_motion();
    while (!ended && !limit_hit()) {
        bool give = false;
        ++lines;
        if (at.block < 0 && (at.byte >= frame().section->read_to || !resolve())) {
            if (!first_reading(give)) continue;
        } else {
            const int index = at.block;
            const Block block = cache.blocks[static_cast<std::size_t>(index)];
            at = {block.end, block.line + 1, block.next};
            link_from = block.next < 0 ? index : -1;
            give = run(block, cache.code, index);
        }
        if (!give) continue;
        if (modal_count == 0 || !call_every_block()) return &words;
    }
    return nullptr;
}

/// Parses and runs the next block from the text; false when it was empty.
bool Interpreter::State::first_reading(bool& give) {
    const std::string_view all = text();
    Section& section = *frame().section;
    current = at;
    link_from = -1;
    const char* p = all.data() + at.byte;
    if (read_plain_block(p, all.data() + all.size(), special, words)) {
        words.line = at.line;
        words.byte = at.byte;
        at = {static_cast<std::uint64_t>(p - all.data()), at.line + 1, -1};
        if (section.read_to < at.byte) section.read_to = at.byte;
        if (words.sequence_number >= 0) sequence_number = words.sequence_number;
        if (words.count == 0) return false;
        ++executed;
        return give = true;
    }
    scratch.clear();
    const Block block = parse_block(all, at.byte, at.line, parse, scratch);
    at = {block.end, block.line + 1, -1};
    if (section.read_to < at.byte) section.read_to = at.byte;
    give = run(block, scratch, -1);
    return true;
}

/// Finds or compiles the block at `at`; false when the cache has no room.
bool Interpreter::State::resolve() {
    Section& section = *frame().section;
    int index = cache.find(section.file->id, at.byte);
    if (index < 0) {
        if (cache.full()) {
            if (++cache_misses < BlockCache::patience) return false;
            flush_cache();
        }
        current = at;
        index =
            cache.add(section.file->id, parse_block(text(), at.byte, at.line, parse, cache.code));
    }
    cache.connect(link_from, index);
    if (at.byte == section.begin.byte) section.first_block = index;
    at.block = index;
    return true;
}

void Interpreter::State::flush_cache() {
    cache.clear();
    cache_misses = 0;
    link_from = -1;
    files.forget_first_blocks();
    for (Frame& f : frames) {
        f.start.block = f.back.block = -1;
        f.back_link = -1;
        for (Place& loop : f.loops) loop.block = -1;
    }
}

/// Runs one block; true when `words` must be returned. `index`: its number in the cache, or -1.
bool Interpreter::State::run(const Block& block, Code& code, int index) {
    current = {block.byte, block.line, index};
    if (block.sequence_number >= 0) sequence_number = block.sequence_number;
    switch (block.kind) {
        case BlockKind::words:
        case BlockKind::computed: return give_out(block, code);
        case BlockKind::statements: statements(block, code, index); return false;
        case BlockKind::program: return program_block(block, code, index);
        case BlockKind::end_of_record: break;
    }
    end_of_section();
    return false;
}

/// The O block of this program, or of the next one, which ends this program.
bool Interpreter::State::program_block(const Block& block, Code& code, int index) {
    if (block.byte != frame().section->begin.byte) {
        end_of_section();
        return false;
    }
    if (block.items.count == 0) return false;
    if (code.items[block.items.first].kind == ItemKind::word) return give_out(block, code);
    statements(block, code, index);
    return false;
}

/// Neither M30 nor M99: a main program ends; a called program returns (assumed).
void Interpreter::State::end_of_section() {
    if (frames.size() == 1) {
        ended = true;
        main_end = MainEnd::out_of_text;
        return;
    }
    give_back(-1, -1);
}

bool Interpreter::State::give_out(const Block& block, const Code& code) {
    if (block.items.count > BlockWords::capacity)
        raise_language_alarm(1090, 1, "too many words in a block");
    if (block.items.count == 0) return false;
    ++executed;
    words.sequence_number = block.sequence_number;
    words.line = block.line;
    words.byte = block.byte;
    words.count = block.items.count;
    std::size_t first_special = words.count;
    const Item* item = code.items.data() + block.items.first;
    for (std::size_t i = 0; i < words.count; ++i, ++item) {
        WordValue& word = words.words[i];
        const double v = value(code, *item);
        word.value = item->negative ? -v : v;
        word.letter = item->letter;
        word.decimal_point = item->decimal_point;
        word.vacant = is_vacant(v);
        word.column = item->column;
        word.computed = item->a.count != 0;
        if (first_special == words.count && (word.letter == '<' || special.has(word.letter, v)))
            first_special = i;
    }
    return first_special == words.count || special_words(block, code, first_special);
}

}  // namespace trunnion::interpreter
