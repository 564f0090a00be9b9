/* Text in, its tree out, by the library that editors use: `parse QUERY FILE...` prints, for each file,
 *
 *     file PATH
 *     node DEPTH FROM TO STATE NAME      in the order of the text; STATE is `named`, `token`, `missing` or `error`
 *     capture FROM TO NAME               of the query, which is a file or `-`
 *     shape TREE                         with the names of fields, instead of nodes, where the query is `+`
 *
 * with offsets in bytes. A query that does not fit the grammar ends it with status 2. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tree_sitter/api.h>

const TSLanguage *tree_sitter_sensedsl(void);

static char *text_of(const char *path, uint32_t *length) {
    FILE *file = fopen(path, "rb");
    if (file == NULL || fseek(file, 0, SEEK_END) != 0) {
        perror(path);
        exit(1);
    }
    const long size = ftell(file);
    char *text = malloc((size_t)size + 1);
    rewind(file);
    if (text == NULL || fread(text, 1, (size_t)size, file) != (size_t)size) {
        perror(path);
        exit(1);
    }
    fclose(file);
    *length = (uint32_t)size;
    return text;
}

static void print_node(TSNode node, unsigned depth) {
    const char *state = ts_node_is_named(node) ? "named" : "token";
    if (ts_node_is_missing(node)) {
        state = "missing";
    } else if (strcmp(ts_node_type(node), "ERROR") == 0) {
        state = "error";
    }
    printf("node %u %u %u %s %s\n", depth, ts_node_start_byte(node), ts_node_end_byte(node), state,
           ts_node_type(node));
}

static void print_tree(TSNode root) {
    TSTreeCursor cursor = ts_tree_cursor_new(root);
    unsigned depth = 0;
    for (;;) {
        print_node(ts_tree_cursor_current_node(&cursor), depth);
        if (ts_tree_cursor_goto_first_child(&cursor)) {
            depth += 1;
            continue;
        }
        while (!ts_tree_cursor_goto_next_sibling(&cursor)) {
            if (!ts_tree_cursor_goto_parent(&cursor)) {
                ts_tree_cursor_delete(&cursor);
                return;
            }
            depth -= 1;
        }
    }
}

static void print_captures(const TSQuery *query, TSNode root) {
    TSQueryCursor *cursor = ts_query_cursor_new();
    ts_query_cursor_exec(cursor, query, root);
    TSQueryMatch match;
    uint32_t index;
    while (ts_query_cursor_next_capture(cursor, &match, &index)) {
        const TSQueryCapture capture = match.captures[index];
        uint32_t length;
        const char *name = ts_query_capture_name_for_id(query, capture.index, &length);
        printf("capture %u %u %s\n", ts_node_start_byte(capture.node),
               ts_node_end_byte(capture.node), name);
    }
    ts_query_cursor_delete(cursor);
}

static TSQuery *query_of(const char *path) {
    uint32_t length;
    uint32_t at;
    TSQueryError error;
    char *source = text_of(path, &length);
    TSQuery *query = ts_query_new(tree_sitter_sensedsl(), source, length, &at, &error);
    if (query == NULL) {
        fprintf(stderr, "%s: mistake %d at byte %u\n", path, (int)error, at);
        exit(2);
    }
    free(source);
    return query;
}

int main(int count, char **arguments) {
    TSParser *parser = ts_parser_new();
    if (count < 2 || !ts_parser_set_language(parser, tree_sitter_sensedsl())) {
        fputs("no query, or a parser that this library does not take\n", stderr);
        return 1;
    }
    const int is_shape = strcmp(arguments[1], "+") == 0;
    const int has_query = !is_shape && strcmp(arguments[1], "-") != 0;
    TSQuery *query = has_query ? query_of(arguments[1]) : NULL;
    for (int at = 2; at < count; ++at) {
        uint32_t length;
        char *text = text_of(arguments[at], &length);
        TSTree *tree = ts_parser_parse_string(parser, NULL, text, length);
        printf("file %s\n", arguments[at]);
        if (is_shape) {
            char *shape = ts_node_string(ts_tree_root_node(tree));
            printf("shape %s\n", shape);
            free(shape);
        } else {
            print_tree(ts_tree_root_node(tree));
        }
        if (has_query) {
            print_captures(query, ts_tree_root_node(tree));
        }
        ts_tree_delete(tree);
        free(text);
    }
    if (has_query) {
        ts_query_delete(query);
    }
    ts_parser_delete(parser);
    return 0;
}
