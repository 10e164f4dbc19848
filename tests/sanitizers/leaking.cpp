// Loses what it allocated. A test runs it as all others, to see that leaks are found and that not all are suppressed.
int main() {
    int* volatile lost = new int[100];
    lost = nullptr;
    return lost != nullptr;
}
