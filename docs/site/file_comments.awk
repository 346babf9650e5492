# Doxygen takes a comment in front of `namespace musim...` for one of the namespace; in our headers it says what the file is for.
/^\/\/\// { comment = comment $0 "\n"; next }
/^namespace musim/ && comment != "" { printf "/// @file\n" }
{ printf "%s", comment; comment = ""; print }
END { printf "%s", comment }
