# programs.awk BUDGET..: joins the budgets of GPUs (tests/gpus/budget), one file each, into the table that
# src/cost/program.h reads: first the GPUs' names, then a line for each program. Columns, separated by tabs: its name; fetches of
# the fragment stage, the most that a compiler said, or -1; then for each GPU instructions of the fragment stage and of all others
# together, or -1 and -1.
FNR == 1 { n = split(FILENAME, path, "/"); gpu = path[n]; gpus[++count] = gpu; next }
{
    name = $0
    sub(/^ *[0-9]+ +[0-9]+ +-?[0-9]+ +[a-z]+ +/, "", name)
    if (!(name in fetches)) { fetches[name] = -1; names[++programs] = name }
    if ($4 != "fragment") other[name, gpu] += $1
    else {
        fragment[name, gpu] = $1
        if ($3 > fetches[name]) fetches[name] = $3
    }
}
END {
    printf "program\tfetches"
    for (g = 1; g <= count; g++) printf "\t%s", gpus[g]
    printf "\n"
    for (p = 1; p <= programs; p++) {
        name = names[p]
        printf "%s\t%d", name, fetches[name]
        for (g = 1; g <= count; g++)
            if ((name, gpus[g]) in fragment) printf "\t%d\t%d", fragment[name, gpus[g]], other[name, gpus[g]]
            else printf "\t-1\t-1"
        printf "\n"
    }
}
