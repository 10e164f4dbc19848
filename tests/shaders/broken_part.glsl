// Included by broken_include.comp: the message must name this file and line 3.
float part() {
    return undeclared;
}
