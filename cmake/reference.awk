# The headers' ordinary comments as Doxygen wants them: above what they are about ///, behind it ///<, and so where they go on
# in the same column below.
function column(line) { return match(line, /\/\//) }

/^[ \t]*\/\/ *----/ { print ""; behind = 0; next }   # only divides a file
/^[ \t]*\/\// {
    if (behind && column($0) == behind) {
        sub(/\/\//, "///<")
    } else {
        behind = 0
        sub(/\/\//, "///")
    }
    print
    next
}
/[;,{})] *\/\/ / || /^[^\/"]*[A-Za-z0-9_]   *\/\/ / {
    behind = column($0)
    sub(/\/\/ /, "///< ")
    print
    next
}
{ behind = 0; print }
