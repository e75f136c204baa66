// A block as written, as plain data: items in order, expressions as reverse Polish code.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trunnion::interpreter {

enum class OpCode : std::uint8_t {
    constant,
    vacant,
    local,
    common,
    system,
    indirect,  // operand count
    negate,
    add,
    subtract,
    multiply,
    divide,
    modulo,
    bit_and,
    bit_or,
    bit_xor,
    equal,
    not_equal,
    greater,
    greater_equal,
    less,
    less_equal,
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    atan2,
    sqrt,
    abs,
    bin,
    bcd,
    round,
    round_increment,
    fix,
    fup,
    ln,
    exp,
    pow,
    adp,
    prm,
    prm_bit,
    prm_axis,
    prm_bit_axis  // 1, 2, 2 and 3 operands
};

/// One step of an expression.
struct Op {
    OpCode code = OpCode::vacant;
    std::uint16_t column = 0;  ///< from 1, for alarms of this step
    std::int32_t number = 0;   ///< variable number of local, common, system
    union {
        double value = 0.0;  ///< constant
        std::uint32_t slot;  ///< common variable: index in the store
    };
};

struct Span {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

enum class ItemKind : std::uint8_t {
    word,      ///< letter; value or expression `a`
    skip,      ///< `/n`: number; the rest of the block is optional
    assign,    ///< #value = a, or #[b] = a
    if_goto,   ///< condition a; the next item is the go_to
    if_then,   ///< condition a; the next item is the assignment
    if_block,  ///< condition a; the blocks up to ELSE or ENDIF
    else_,     ///< the blocks up to ENDIF, if the condition of the if_block was false
    end_if,
    while_do,  ///< condition a, loop number
    do_only,   ///< DO n
    end,       ///< END n
    go_to,     ///< value, or expression a
    popen,
    pclos,
    dprnt,
    bprnt,
    print_text,   ///< part of a print statement: characters b of Code::text
    print_value,  ///< part of a print statement: a in the format number.digits
    setvn         ///< variable `value` and the following get the names b of Code::text
};

struct Item {
    ItemKind kind = ItemKind::word;
    char letter = 0;          ///< upper case; comma words lower case; '<' for the called name of
                              ///< `M98<NAME>`: characters b of Code::text
    std::uint8_t number = 0;  ///< loop, skip switch, digits before the point
    std::uint8_t digits = 0;  ///< digits after the point of print_value
    std::uint16_t column = 0;
    bool decimal_point = true;
    bool negative = false;  ///< word `X-#1`: the sign keeps a vacant value vacant
    double value = 0.0;     ///< used when the expression `a` (target `b`) is empty
    Span a, b;
    std::int32_t link = -1;  ///< jumps: index into the runner's links
};

struct Comment {
    std::uint64_t byte = 0;  ///< of the text after '('
    std::uint32_t size = 0;
    std::uint16_t column = 0;  ///< of the '('
    bool leading = false;      ///< precedes the first item or '='
};

/// Kind of a line.
enum class BlockKind : std::uint8_t {
    words,          ///< all values are constant; no evaluation needed
    computed,       ///< words with expressions
    statements,     ///< macro statements
    program,        ///< starts a program (O, ':' or <name>); may also have items
    end_of_record,  ///< '%', Ctrl-Z, the end of the text, or a folder line `&F=..`
};

struct Block {
    std::uint64_t byte = 0;  ///< where it starts
    std::uint64_t end = 0;   ///< where the next one starts
    std::int32_t line = 0;   ///< from 1
    std::int32_t sequence_number = -1;
    std::int32_t o_number = -1;
    std::int32_t next = -1;      ///< the runner's link to the next block
    Span items, comments, name;  ///< name: offset from `byte` and size, without < >
    BlockKind kind = BlockKind::words;
};

/// Storage for the parts of parsed blocks.
struct Code {
    std::vector<Item> items;
    std::vector<Op> ops;
    std::vector<Comment> comments;
    std::string text;

    void clear() {
        items.clear();
        ops.clear();
        comments.clear();
        text.clear();
    }
    std::size_t bytes() const {
        return items.size() * sizeof(Item) + ops.size() * sizeof(Op) +
               comments.size() * sizeof(Comment) + text.size();
    }
};

}  // namespace trunnion::interpreter
