#include "unit/tree_memory.h"

#include <dirent.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FILES_MAX = 64 };
struct files { /* in memory */
    ino_t inodes[FILES_MAX];
    int count;
};

static int64_t private_kb(pid_t pid) {
    char path[64], line[200];
    int64_t kb = 0;
    snprintf(path, sizeof path, "/proc/%d/status", (int)pid);
    FILE *file = fopen(path, "re");
    while (file && fgets(line, sizeof line, file)) sscanf(line, "RssAnon: %" SCNd64, &kb);
    if (file) fclose(file);
    return kb;
}

static bool is_new(struct files *files, ino_t inode) {
    for (int i = 0; i < files->count; i++)
        if (files->inodes[i] == inode) return false;
    if (files->count < FILES_MAX) files->inodes[files->count++] = inode;
    return true;
}

static int64_t files_kb(pid_t pid, struct files *files) {
    char folder[64], path[400], target[200];
    int64_t kb = 0;
    snprintf(folder, sizeof folder, "/proc/%d/fd", (int)pid);
    DIR *list = opendir(folder);
    for (const struct dirent *entry; list && (entry = readdir(list));) {
        struct stat info;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        const ssize_t length = readlink(path, target, sizeof target - 1);
        if (length < 0 || strncmp(target, "/memfd:", 7) != 0 || stat(path, &info) != 0) continue;
        if (is_new(files, info.st_ino)) kb += info.st_blocks / 2;
    }
    if (list) closedir(list);
    return kb;
}

static int64_t tree_kb(pid_t pid, struct files *files) {
    char path[64];
    int child;
    int64_t kb = private_kb(pid) + files_kb(pid, files);
    snprintf(path, sizeof path, "/proc/%d/task/%d/children", (int)pid, (int)pid);
    FILE *children = fopen(path, "re");
    while (children && fscanf(children, "%d", &child) == 1) kb += tree_kb(child, files);
    if (children) fclose(children);
    return kb;
}

int64_t gn_tree_memory_kb(pid_t pid) {
    struct files files = {.count = 0};
    return tree_kb(pid, &files);
}
